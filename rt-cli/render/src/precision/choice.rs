//! The lightest triangle test that is good enough.

use rt_scene::{Scene, View};

use super::band::{Prediction, predict};
use super::table::ERRORS;
use crate::Method;

/// A triangle test and why it is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The test.
    pub method: Method,
    /// What each gets wrong, at most, lightest first.
    pub predictions: [Prediction; ERRORS.len()],
}

impl Choice {
    /// What the test gets wrong, at most.
    pub fn prediction(&self) -> &Prediction {
        let of_method = self.predictions.iter().find(|p| p.method == self.method);
        of_method.expect("there is a prediction for every method")
    }
}

/// The lightest triangle test that stays under a tolerance, in pixels: the watertight one if no
/// other does. With a tolerance of 0 none does.
pub fn choose(scene: &Scene, view: &View, size: (u32, u32), tolerance: f64) -> Choice {
    let predictions = predict(scene, view, size);
    let triangles = scene.mesh.triangles.len();
    let good = ERRORS.iter().zip(&predictions).find(|(errors, prediction)| {
        prediction.pixels < tolerance && triangles <= errors.most_triangles
    });
    let method = good.map_or(Method::default(), |(errors, _)| errors.method);
    Choice { method, predictions }
}
