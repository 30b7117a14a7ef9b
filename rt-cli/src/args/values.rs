//! What flags may be set to.

use glam::Vec3;
use rt_render::Crop;
use rt_scene::Light;

pub(super) fn size(text: &str) -> Result<(u32, u32), String> {
    let (width, height) = text.split_once('x').ok_or("expected WIDTHxHEIGHT, as in 640x480")?;
    let number = |text: &str| match text.parse() {
        Ok(pixels) if pixels > 0 => Ok(pixels),
        _ => Err(format!("{text:?} is not a number of pixels")),
    };
    Ok((number(width)?, number(height)?))
}

/// A rectangle: the column and row of its upper left corner, its width and height.
pub(super) fn crop(text: &str) -> Result<Crop, String> {
    let number = |text: &str| text.trim().parse::<u32>();
    let numbers: Result<Vec<_>, _> = text.split(',').map(number).collect();
    match numbers.as_deref() {
        Ok(&[left, top, width, height]) if width > 0 && height > 0 => {
            Ok(Crop { left, top, width, height })
        }
        _ => Err("expected X,Y,WIDTH,HEIGHT in pixels, as in 0,0,64,32".into()),
    }
}

fn numbers(text: &str) -> Result<Vec<f32>, String> {
    let number = |text: &str| match text.trim().parse::<f32>() {
        Ok(x) if x.is_finite() => Ok(x),
        _ => Err(format!("{text:?} is not a finite number")),
    };
    text.split(',').map(number).collect()
}

pub(super) fn vec3(text: &str) -> Result<Vec3, String> {
    match numbers(text)?[..] {
        [x, y, z] => Ok(Vec3::new(x, y, z)),
        _ => Err("expected three numbers with commas between them".into()),
    }
}

pub(super) fn color(text: &str) -> Result<Vec3, String> {
    match vec3(text)? {
        color if color.min_element() < 0.0 => Err("a colour has no negative parts".into()),
        color => Ok(color),
    }
}

pub(super) fn light(text: &str) -> Result<Light, String> {
    match numbers(text)?[..] {
        [x, y, z] => Ok(Light { position: Vec3::new(x, y, z), color: Vec3::ONE }),
        [x, y, z, r, g, b] => Ok(Light { position: Vec3::new(x, y, z), color: Vec3::new(r, g, b) }),
        _ => Err("expected three numbers, or six with a colour".into()),
    }
}

/// A size that the kernels make promises for.
pub(super) fn scale(text: &str) -> Result<f32, String> {
    match numbers(text)?[..] {
        [scale] if (1e-6..=1e6).contains(&scale) => Ok(scale),
        _ => Err("expected a size from 1e-6 to 1e6".into()),
    }
}

pub(super) fn offset(text: &str) -> Result<f32, String> {
    match numbers(text)?[..] {
        [offset] if (0.0..=1e6).contains(&offset) => Ok(offset),
        _ => Err("expected a distance from 0 to 1e6".into()),
    }
}

pub(super) fn tolerance(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(pixels) if pixels.is_finite() && pixels.is_sign_positive() => Ok(pixels),
        _ => Err("expected a number of pixels, 0 or more".into()),
    }
}

pub(super) fn angle(text: &str) -> Result<f32, String> {
    match numbers(text)?[..] {
        [degrees] if degrees > 0.0 && degrees < 180.0 => Ok(degrees),
        _ => Err("expected an angle between 0 and 180 degrees".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_read_whole_or_refused() {
        assert_eq!(size("640x480"), Ok((640, 480)));
        for bad in ["640", "0x5", "5x0", "x", "-1x5", "5x5x5", "4294967296x1"] {
            assert!(size(bad).is_err(), "{bad}");
        }
        let corner = Crop { left: 3, top: 0, width: 10, height: 7 };
        assert_eq!(crop("3, 0,10,7"), Ok(corner));
        for bad in ["", "1,2,3", "1,2,3,4,5", "-1,0,3,3", "0,0,0,5", "0,0,5,0", "0,0,1.5,2", "a"] {
            assert!(crop(bad).is_err(), "{bad}");
        }
        assert_eq!(vec3("-1, 2.5,3e2"), Ok(Vec3::new(-1.0, 2.5, 300.0)));
        for bad in ["", "1,2", "1,2,3,4", "1,2,nan", "1,2,inf", "1,2,1e39", "1;2;3"] {
            assert!(vec3(bad).is_err(), "{bad}");
        }
        assert_eq!(light("1,2,3").unwrap().color, Vec3::ONE);
        assert_eq!(light("1,2,3,4,5,6").unwrap().color, Vec3::new(4.0, 5.0, 6.0));
        assert!(light("1,2,3,4").is_err());
        assert!(color("0,-1,0").is_err() && color("0,0.5,9").is_ok());
        assert_eq!((tolerance("0"), tolerance("0.5")), (Ok(0.0), Ok(0.5)));
        for bad in ["", "-1", "-0.0", "nan", "inf", "1px", "1,5"] {
            assert!(tolerance(bad).is_err(), "{bad}");
        }
        assert_eq!((scale("1e-6"), scale("1e6")), (Ok(1e-6), Ok(1e6)));
        assert_eq!((offset("0"), offset("1e6")), (Ok(0.0), Ok(1e6)));
        for bad in ["", "0", "-1", "2e6", "nan", "1,1"] {
            assert!(scale(bad).is_err(), "{bad}");
            assert!(bad == "0" || offset(bad).is_err(), "{bad}");
        }
        assert!(angle("0").is_err() && angle("180").is_err() && angle("45").is_ok());
    }
}
