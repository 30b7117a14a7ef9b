//! Precision in words and in JSON.

use rt_render::Method;
use rt_render::precision::{Choice, ERRORS, Facts, Over, Prediction};
use serde_json::{Value, json};

/// Why a triangle test was taken.
pub(crate) enum Kernel {
    /// It was asked for, or is the default.
    Asked(Method),
    /// It is the cheapest over a structure that stays under so many pixels.
    Chosen(Choice, Over, f64),
}

impl Kernel {
    /// The triangle test.
    pub(crate) fn method(&self) -> Method {
        match self {
            Kernel::Asked(method) => *method,
            Kernel::Chosen(choice, ..) => choice.method,
        }
    }

    /// For the closing line.
    pub(crate) fn words(&self) -> String {
        let name = self.method().name();
        match self {
            Kernel::Asked(_) => format!("{name} kernel"),
            Kernel::Chosen(choice, over, tolerance) => {
                let pixels = digits(choice.prediction().pixels);
                let stays = |p: &Prediction| p.method != choice.method && p.pixels < *tolerance;
                let why = match (choice.method, over) {
                    (Method::Watertight, Over::WideNodes) => {
                        "over wide nodes none is cheaper".into()
                    }
                    (Method::Watertight, _) if choice.predictions.iter().any(stays) => {
                        format!("none that stays under {tolerance} px is cheaper here")
                    }
                    (Method::Watertight, _) => format!("no cheaper one stays under {tolerance} px"),
                    _ => format!("off by at most {pixels} px, tolerance {tolerance} px"),
                };
                format!("{name} kernel ({why})")
            }
        }
    }

    /// What the tolerance was and what was foretold; null if there was none.
    pub(crate) fn json(&self) -> Value {
        match self {
            Kernel::Asked(_) => Value::Null,
            Kernel::Chosen(choice, _, tolerance) => json!({
                "px": tolerance,
                "predicted": predictions_json(&choice.predictions),
            }),
        }
    }
}

/// What decides precision, and what follows for a camera.
pub(crate) fn facts_json(facts: &Facts, predictions: &[Prediction]) -> Value {
    json!({
        "largest_coordinate": facts.largest_coordinate,
        "smallest_feature": facts.smallest_feature,
        "ratio": facts.ratio(),
        "worst_aspect": facts.worst_aspect,
        "boxes_met": facts.boxes_met,
        "degenerate": facts.degenerate,
        "duplicates": facts.duplicates,
        "curved": facts.curved,
        "kernels": predictions_json(predictions),
    })
}

/// The same as names and values of lines.
pub(crate) fn facts_lines(
    facts: &Facts,
    predictions: &[Prediction],
) -> Vec<(&'static str, String)> {
    let mut lines = Vec::new();
    if let (Some(feature), Some(ratio)) = (facts.smallest_feature, facts.ratio()) {
        let text = format!(
            "coordinates up to {}, features down to {}: ratio {}",
            digits(facts.largest_coordinate),
            digits(feature),
            digits(ratio),
        );
        lines.push(("precision", text));
    }
    if let Some(aspect) = facts.worst_aspect {
        lines.push(("slivers", format!("up to {} times as long as high", digits(aspect))));
    }
    if facts.triangles > 0 {
        let met = digits(facts.boxes_met);
        lines.push(("crowding", format!("a line meets the boxes of {met} triangles on average")));
    }
    for (what, count) in [("degenerate", facts.degenerate), ("duplicates", facts.duplicates)] {
        if count > 0 {
            lines.push((what, super::count(count, "triangle")));
        }
    }
    if facts.curved > 0 {
        let spheres = super::count(facts.curved, "sphere");
        lines.push(("curved", format!("{spheres}, exact and never flattened")));
    }
    for (prediction, errors) in predictions.iter().zip(&ERRORS) {
        let Prediction { method, band, depth, pixels } = prediction;
        let pays = errors.pays(Over::SkipArray, facts.triangles, facts.boxes_met);
        let verdict = match (method, pays) {
            (Method::Watertight, _) => "keeps the promise: no leaks",
            (_, true) => "cheaper over skip arrays",
            _ => "no cheaper here",
        };
        let text = format!(
            "{}: band {}, depth {}: at most {} px; {verdict}",
            method.name(),
            digits(*band),
            digits(*depth),
            digits(*pixels),
        );
        lines.push(("kernel", text));
    }
    lines
}

fn predictions_json(predictions: &[Prediction]) -> Value {
    let one = |p: &Prediction| {
        // JSON has no infinity: null is no bound at all.
        let finite = |x: f64| x.is_finite().then_some(x);
        json!({
            "kernel": p.method.name(),
            "leaks": p.method != Method::Watertight,
            "band": finite(p.band),
            "depth": finite(p.depth),
            "px": finite(p.pixels),
        })
    };
    predictions.iter().map(one).collect()
}

/// Three digits, with an exponent where there would be many zeros.
fn digits(x: f64) -> String {
    match x {
        _ if !x.is_finite() => "∞".to_owned(),
        0.0 => "0".to_owned(),
        0.01..1.0 => format!("{x:.3}"),
        1.0..100.0 => format!("{x:.2}"),
        100.0..1e6 => format!("{x:.0}"),
        _ => format!("{x:.2e}"),
    }
}

#[cfg(test)]
mod tests {
    use super::digits;

    #[test]
    fn numbers_are_short() {
        let cases = [(0.0, "0"), (0.0123, "0.012"), (1.0, "1.00"), (12345.6, "12346")];
        for (x, text) in cases {
            assert_eq!(digits(x), text);
        }
        assert_eq!((digits(1.5e-7), digits(2.5e9)), ("1.50e-7".into(), "2.50e9".into()));
        assert_eq!(digits(f64::INFINITY), "∞");
    }
}
