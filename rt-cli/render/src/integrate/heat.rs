//! What it costs to find what is seen.

use glam::Vec3;
use rt_kernels::{Exec, PacketSize};

use super::{RayKind, Scratch};
use crate::Job;
use crate::exec::{Tally, TileJob};

/// Colours at equal ratios of steps, from none to the most that are told apart.
const RAMP: [Vec3; 6] = [
    Vec3::ZERO,
    Vec3::new(0.0, 0.0, 0.6),
    Vec3::new(0.0, 0.5, 0.2),
    Vec3::new(0.8, 0.7, 0.0),
    Vec3::new(1.0, 0.1, 0.0),
    Vec3::ONE,
];

/// Steps that are white, and one more.
const MOST: f64 = 256.0;

/// Traces the primary rays one by one, and gives each the colour of its steps: nodes that it visits
/// and primitives that it is tested against.
pub(super) fn integrate(
    job: &TileJob<'_>,
    scratch: &mut Scratch,
    colors: &mut [Vec3],
    tally: &mut Tally,
) {
    // Packets share their steps, which then depend on the level.
    let alone = Exec { packet: PacketSize::Single, ..job.job.exec };
    let alone = Job { exec: job.world.exec(alone), ..job.job.clone() };
    let TileJob { world, camera, lights, depth_range, .. } = *job;
    let alone = TileJob { world, job: &alone, camera, lights, depth_range, pixels: Vec::new() };
    let all: Vec<_> = (0..scratch.rays.len()).map(|i| scratch.rays.get(i)).collect();
    for (ray, color) in all.into_iter().zip(colors) {
        scratch.rays.clear();
        scratch.rays.extend([ray]);
        let before = tally.steps();
        tally.closest(&alone, RayKind::Primary, &scratch.rays, &mut scratch.hits);
        *color += heat(tally.steps() - before);
    }
}

/// The colour of so many steps.
fn heat(steps: u64) -> Vec3 {
    let last = (RAMP.len() - 1) as f64;
    let place = (libm::log2(1.0 + steps as f64) / libm::log2(MOST)).min(1.0) * last;
    let below = (place as usize).min(RAMP.len() - 2);
    let share = (place - below as f64) as f32;
    RAMP[below] * (1.0 - share) + RAMP[below + 1] * share
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn more_steps_are_hotter_until_they_are_white() {
        assert_eq!((heat(0), heat(255), heat(u64::MAX)), (Vec3::ZERO, Vec3::ONE, Vec3::ONE));
        // log2(1 + 2) / 8 is a fifth, but for a hair.
        assert!(heat(2).distance(RAMP[1]) < 0.02, "{}", heat(2));
        let all: Vec<_> = (0..256).map(heat).collect();
        assert!(all.windows(2).all(|two| two[0] != two[1]), "each has a colour of its own");
    }
}
