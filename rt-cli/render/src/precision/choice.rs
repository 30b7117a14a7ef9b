//! The cheapest triangle test that is good enough.

use rt_scene::{Scene, View};

use super::band::{Prediction, predict};
use super::facts::boxes_met;
use super::table::{ERRORS, Over};
use crate::Method;

/// A triangle test and why it is taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Choice {
    /// The test.
    pub method: Method,
    /// What each gets wrong, at most, cheapest first.
    pub predictions: [Prediction; ERRORS.len()],
}

impl Choice {
    /// What the test gets wrong, at most.
    pub fn prediction(&self) -> &Prediction {
        let of_method = self.predictions.iter().find(|p| p.method == self.method);
        of_method.expect("there is a prediction for every method")
    }
}

/// The cheapest triangle test that stays under a tolerance, in pixels: the watertight one if no
/// other does, or none that does pays in that scene `over` that structure. With a tolerance of 0 none
/// does.
pub fn choose(scene: &Scene, view: &View, size: (u32, u32), tolerance: f64, over: Over) -> Choice {
    let predictions = predict(scene, view, size);
    let (triangles, boxes_met) = (scene.mesh.triangles.len(), boxes_met(scene));
    let good = ERRORS.iter().zip(&predictions).find(|(errors, prediction)| {
        prediction.pixels < tolerance && errors.pays(over, triangles, boxes_met)
    });
    let method = good.map_or(Method::default(), |(errors, _)| errors.method);
    Choice { method, predictions }
}
