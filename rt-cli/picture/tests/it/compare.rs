//! Differences with known answers.

use glam::Vec3;
use rt_picture::{Picture, Scale, compare};

fn picture(scale: Scale, pixels: &[[f32; 3]]) -> Picture {
    let pixels: Vec<_> = pixels.iter().map(|&pixel| Vec3::from_array(pixel)).collect();
    Picture { width: 2, height: pixels.len() as u32 / 2, scale, pixels }
}

#[test]
fn a_picture_does_not_differ_from_itself() {
    let odd = [[f32::NAN, f32::INFINITY, -1.0], [0.0, -0.0, 3.0]];
    let a = picture(Scale::Linear, &odd);
    let difference = compare(&a, &a).unwrap();
    assert_eq!((difference.mse, difference.max, difference.pixels), (0.0, 0.0, 0));
    assert_eq!((difference.psnr(), difference.worst), (f64::INFINITY, None));
}

#[test]
fn the_numbers_are_what_they_are_called() {
    let a = picture(Scale::Linear, &[[0.0; 3], [1.0; 3], [0.5, 0.25, 2.0], [0.0; 3]]);
    let b = picture(Scale::Linear, &[[0.0; 3], [1.0; 3], [0.5, 0.75, 0.0], [0.0, 0.25, 0.0]]);
    let difference = compare(&a, &b).unwrap();
    assert_eq!(difference.scale, Scale::Linear);
    assert_eq!(difference.mse, (0.25 + 4.0 + 0.0625) / 12.0);
    assert_eq!((difference.max, difference.worst), (2.0, Some((0, 1))));
    assert_eq!(difference.pixels, 2);
    assert_eq!(difference.picture.pixels[2], Vec3::new(0.0, 0.5, 2.0));
    assert!((difference.psnr() - 10.0 * (12.0_f64 / 4.3125).log10()).abs() < 1e-12);
}

#[test]
fn light_is_shown_before_it_is_compared_with_codes() {
    // 0.5 of light is sRGB 0.7353…; what is beyond white is white.
    let a = picture(Scale::Linear, &[[0.5, 7.0, -3.0], [0.0; 3]]);
    let b = picture(Scale::Srgb, &[[0.735_357, 1.0, 0.0], [0.0; 3]]);
    for difference in [compare(&a, &b).unwrap(), compare(&b, &a).unwrap()] {
        assert_eq!(difference.scale, Scale::Srgb);
        assert!(difference.max < 2e-7, "{difference:?}");
    }
    // Two of codes are compared as they are.
    let c = picture(Scale::Srgb, &[[0.5, 1.0, 0.0], [0.0; 3]]);
    assert_eq!(compare(&b, &c).unwrap().max, f64::from(0.735_357_f32) - 0.5);
}

#[test]
fn what_is_no_number_differs_infinitely() {
    let a = picture(Scale::Linear, &[[f32::NAN, 0.0, 0.0], [0.0; 3]]);
    let b = picture(Scale::Linear, &[[1.0, 0.0, 0.0], [0.0; 3]]);
    let difference = compare(&a, &b).unwrap();
    assert_eq!((difference.max, difference.pixels), (f64::INFINITY, 1));
    assert_eq!(difference.psnr(), f64::NEG_INFINITY);
}

#[test]
fn pictures_of_other_sizes_are_not_compared() {
    let a = picture(Scale::Srgb, &[[0.0; 3]; 4]);
    let b = picture(Scale::Srgb, &[[0.0; 3]; 6]);
    assert_eq!(compare(&a, &b), None);
}
