//! `rt compare`.

use std::path::Path;

use glam::Vec3;
use rt_picture::{Difference, Format, Picture, Scale, compare};
use serde_json::{Value, json};

use crate::args::{CompareArgs, picture_format};
use crate::error::Error;
use crate::output::{self, Output, read_file};
use crate::report;

/// Prints how much two pictures differ, and holds it against the limits.
pub(crate) fn run(args: &CompareArgs) -> Result<(), Error> {
    let output = match &args.output {
        Some(path) => Some((picture_format(path)?, Output::open(path)?)),
        None => None,
    };
    let [a, b] = [read(&args.a)?, read(&args.b)?];
    let difference = compare(&a, &b).ok_or_else(|| Error::Sizes {
        a: (args.a.clone(), a.width, a.height),
        b: (args.b.clone(), b.width, b.height),
    })?;
    if let Some((format, output)) = output {
        let picture = amplified(&difference, format, args.gain);
        output.write(&rt_picture::write(&picture, format, &[])?)?;
    }
    let total = a.pixels.len() as u64;
    let text = match args.json {
        true => output::json(&facts(&difference, total)),
        false => words(&difference, total),
    };
    // A picture on standard output is alone there.
    if args.output.as_deref() != Some(Path::new("-")) {
        output::to_stdout(text.as_bytes())?;
    }
    let missed = missed(&difference, args);
    if missed.is_empty() { Ok(()) } else { Err(Error::Different(missed)) }
}

fn read(path: &Path) -> Result<Picture, Error> {
    let bytes = read_file(path)?;
    rt_picture::read(&bytes).map_err(|source| Error::Picture { path: path.into(), source })
}

/// The limits that are missed.
fn missed(difference: &Difference, args: &CompareArgs) -> Vec<String> {
    let mut missed = Vec::new();
    let mut hold = |name: &str, found: String, limit: Option<String>, good: bool| {
        if let Some(limit) = limit.filter(|_| !good) {
            missed.push(format!("{name} is {found}, --{limit}"));
        }
    };
    let text = |flag: &str, limit: Option<f64>| limit.map(|limit| format!("{flag} {limit}"));
    let (mse, psnr, max) = (difference.mse, difference.psnr(), difference.max);
    let below = |found: f64, limit: Option<f64>| limit.is_none_or(|limit| found <= limit);
    hold("MSE", number(mse), text("max-mse", args.max_mse), below(mse, args.max_mse));
    let loud = args.min_psnr.is_none_or(|limit| psnr >= limit);
    hold("PSNR", format!("{psnr:.2} dB"), text("min-psnr", args.min_psnr), loud);
    let within = below(max, args.max_difference);
    hold(
        "the greatest difference",
        number(max),
        text("max-difference", args.max_difference),
        within,
    );
    let few = args.max_pixels.is_none_or(|limit| difference.pixels <= limit);
    let limit = args.max_pixels.map(|limit| format!("max-pixels {limit}"));
    hold("the number of pixels that differ", difference.pixels.to_string(), limit, few);
    missed
}

fn words(difference: &Difference, total: u64) -> String {
    let scale = match difference.scale {
        Scale::Linear => "linear",
        Scale::Srgb => "sRGB, 0 to 1",
    };
    let codes = match difference.scale {
        Scale::Srgb => format!(" ({:.1} of 255)", difference.max * 255.0),
        Scale::Linear => String::new(),
    };
    let worst = difference.worst.map_or(String::new(), |(x, y)| format!(" at {x},{y}"));
    let percent = 100.0 * difference.pixels as f64 / total as f64;
    let lines = [
        ("compared", scale.to_owned()),
        ("MSE", number(difference.mse)),
        ("PSNR", format!("{:.2} dB", difference.psnr())),
        ("greatest", format!("{}{codes}{worst}", number(difference.max))),
        (
            "differing",
            format!(
                "{} of {} ({percent:.3} %)",
                difference.pixels,
                report::count(total as usize, "pixel")
            ),
        ),
    ];
    lines.map(|(what, value)| format!("{what:<12}{value}\n")).concat()
}

fn facts(difference: &Difference, total: u64) -> Value {
    json!({
        "scale": if difference.scale == Scale::Linear { "linear" } else { "srgb" },
        "mse": difference.mse,
        // Null where it is infinite.
        "psnr": difference.psnr(),
        "max_difference": difference.max,
        "worst_pixel": difference.worst.map(|(x, y)| [x, y]),
        "differing_pixels": difference.pixels,
        "pixels": total,
        "identical": difference.pixels == 0,
    })
}

/// The difference image, for a format.
fn amplified(difference: &Difference, format: Format, gain: Option<f64>) -> Picture {
    let greatest = difference.max;
    let gain = gain.unwrap_or(match format {
        Format::Png(_) if greatest > 0.0 && greatest.is_finite() => 1.0 / greatest,
        _ => 1.0,
    });
    let channel = |x: f32| (f64::from(x) * gain) as f32;
    let pixels = difference.picture.pixels.iter();
    let pixels = pixels.map(|pixel| Vec3::from_array(pixel.to_array().map(channel))).collect();
    // Numbers become codes as they are: what is twice as bright differs twice as much.
    let scale = if let Format::Png(_) = format { Scale::Srgb } else { Scale::Linear };
    Picture { scale, pixels, ..difference.picture.clone() }
}

/// Few digits, and all of what is small.
fn number(x: f64) -> String {
    match x {
        0.0 => "0".to_owned(),
        _ if (1e-3..1e6).contains(&x) => format!("{x:.6}"),
        _ => format!("{x:.3e}"),
    }
}
