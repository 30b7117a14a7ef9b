//! Numbers as people read them.

use std::time::Duration;

use glam::Vec3;
use rt_render::Crop;
use rt_scene::View;

/// The flags that give a view: read again, they give every bit of it.
pub(crate) fn flags(view: &View) -> String {
    format!(
        "--eye {} --target {} --up {} --fov {}",
        list(view.eye),
        list(view.target),
        list(view.up),
        number(view.fov_y)
    )
}

/// A point or a colour, as flags take it.
pub(crate) fn list(v: Vec3) -> String {
    v.to_array().map(number).join(",")
}

/// A crop, as its flag takes it.
pub(crate) fn crop(crop: Crop) -> String {
    format!("{},{},{},{}", crop.left, crop.top, crop.width, crop.height)
}

/// The shortest decimal that is read as the same number; with an exponent where there would be a
/// long row of zeros.
fn number(x: f32) -> String {
    let plain = x.to_string();
    if plain.len() > 15 { format!("{x:e}") } else { plain }
}

/// `patch` as `patches`.
pub(crate) fn plural(noun: &str) -> String {
    format!("{noun}{}", if noun.ends_with("ch") { "es" } else { "s" })
}

/// `1 thread`, `2 threads`.
pub(crate) fn count(n: usize, noun: &str) -> String {
    match n {
        1 => format!("1 {noun}"),
        n => format!("{n} {}", plural(noun)),
    }
}

/// Those that there are any of: `2 triangles, 1 sphere`.
pub(crate) fn number_of(kinds: &[(&str, usize)]) -> String {
    let some = kinds.iter().filter(|(_, n)| *n > 0);
    some.map(|(kind, n)| count(*n, kind)).collect::<Vec<_>>().join(", ")
}

/// A time in three digits or so.
pub(crate) fn time(time: Duration) -> String {
    let seconds = time.as_secs_f64();
    match seconds {
        0.0..0.01 => format!("{:.2} ms", seconds * 1e3),
        0.01..0.9995 => format!("{:.0} ms", seconds * 1e3),
        0.9995..59.95 => format!("{seconds:.1} s"),
        _ => {
            let whole = seconds.round() as u64;
            format!("{} min {:02} s", whole / 60, whole % 60)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_readable() {
        let cases = [
            (0, "0.00 ms"),
            (420, "0.42 ms"),
            (9_400, "9.40 ms"),
            (90_600, "91 ms"),
            (999_499, "999 ms"),
            (999_600, "1.0 s"),
            (59_940_000, "59.9 s"),
            (59_960_000, "1 min 00 s"),
            (3_725_000_000, "62 min 05 s"),
        ];
        for (micros, text) in cases {
            assert_eq!(time(Duration::from_micros(micros)), text);
        }
    }

    #[test]
    fn one_is_not_many() {
        assert_eq!(
            number_of(&[("triangle", 1), ("sphere", 0), ("patch", 2)]),
            "1 triangle, 2 patches"
        );
        assert_eq!(count(0, "thread"), "0 threads");
    }

    #[test]
    fn numbers_come_back_whole_and_short() {
        for x in [0.0, -0.0, 1.0, 0.1, 1e-38, f32::MIN_POSITIVE, f32::MAX, -1.4286883e15, 1.0 / 3.0]
        {
            let text = number(x);
            assert_eq!(text.parse::<f32>().unwrap().to_bits(), x.to_bits(), "{text}");
            assert!(text.len() <= 15, "{text}");
        }
        assert_eq!(number(40.0), "40");
    }
}
