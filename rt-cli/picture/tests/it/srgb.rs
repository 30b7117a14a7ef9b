//! The curve of sRGB.

use proptest::prelude::*;
use rt_picture::srgb::{decode, encode, encode8, encode16};

/// The standard's own formula, by the platform's power.
fn curve(linear: f64) -> f64 {
    let linear = linear.clamp(0.0, 1.0);
    if linear <= 0.0031308 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 }
}

#[test]
fn it_has_its_known_values() {
    let known = [(0.0, 0), (1.0, 255), (0.5, 188), (0.2158605, 128), (0.0031308, 10)];
    for (linear, code) in known {
        assert_eq!(encode8(linear), code, "{linear}");
    }
    for (linear, code) in [(0.0, 0), (1.0, 65535), (0.5, 48_192), (0.001, 847)] {
        assert_eq!(encode16(linear), code, "{linear}");
    }
    for (bad, code8, code16) in
        [(f32::NAN, 0, 0), (-1.0, 0, 0), (f32::INFINITY, 255, 65535), (-0.0, 0, 0)]
    {
        assert_eq!((encode8(bad), encode16(bad)), (code8, code16), "{bad}");
    }
}

#[test]
fn every_code_comes_back() {
    for code in 0..=255_u8 {
        assert_eq!(encode8(decode(f64::from(code) / 255.0) as f32), code);
    }
    for code in 0..=u16::MAX {
        assert_eq!(encode16(decode(f64::from(code) / 65535.0) as f32), code);
    }
}

proptest! {
    #[test]
    fn codes_are_nearest(linear in 0.0..1.0_f32) {
        let (code8, code16) = (f64::from(encode8(linear)), f64::from(encode16(linear)));
        let exact = curve(linear.into());
        prop_assert!((code8 - 255.0 * exact).abs() <= 0.5001);
        prop_assert!((code16 - 65535.0 * exact).abs() <= 0.5001);
        prop_assert!((encode(linear.into()) - exact).abs() < 1e-12);
    }
}
