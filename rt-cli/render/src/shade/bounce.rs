//! Where a surface sends rays on to: reflection, refraction, and how light is shared out between
//! them.

use glam::Vec3;

use super::{Finish, Surface};

/// A ray that a surface sends on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Sent {
    /// Where it starts, off the surface on its side.
    pub(crate) origin: Vec3,
    /// Its direction, of unit length.
    pub(crate) dir: Vec3,
    /// What it contributes.
    pub(crate) weight: Vec3,
}

/// The reflected and the refracted ray; weights of zero where there is none.
///
/// Where light cannot leave ([Snell's law](refract) has no solution), all that would go through is
/// reflected. No surface gives back more than it gets: weights that add up to more than 1 are scaled
/// down.
pub(crate) fn bounce(surface: &Surface, finish: &Finish, dir: Vec3) -> [Sent; 2] {
    let normal = finish.normal;
    let cosine = (-dir.dot(normal)).clamp(0.0, 1.0);
    let ratio = if surface.point.front { 1.0 / finish.ior } else { finish.ior };
    let (mut mirror, mut through) = (finish.mirror, finish.transmission);
    let mut refracted = Vec3::ZERO;
    if through != Vec3::ZERO {
        match refract(dir, normal, cosine, ratio) {
            Some((bent, cosine_behind)) => {
                refracted = bent;
                if finish.fresnel {
                    let share = fresnel(cosine, cosine_behind, ratio);
                    mirror *= share;
                    through *= 1.0 - share;
                }
            }
            None => (mirror, through) = (mirror + through, Vec3::ZERO),
        }
    } else if finish.fresnel && mirror != Vec3::ZERO {
        mirror = schlick(mirror, cosine);
    }
    let most = (mirror + through).max_element();
    if most > 1.0 {
        (mirror, through) = (mirror / most, through / most);
    }

    // A bent normal may send the ray to the wrong side of the surface, where there is nothing to see.
    let true_normal = surface.point.true_normal;
    let reflected = reflect(dir, normal);
    let leaves = reflected.dot(true_normal) > 0.0;
    let reflected = if leaves { reflected } else { reflect(dir, true_normal) };
    let enters = refracted.dot(true_normal) < 0.0;
    let refracted = if enters { refracted } else { dir };
    [
        Sent { origin: surface.leave, dir: reflected, weight: mirror },
        Sent { origin: surface.enter, dir: refracted, weight: through },
    ]
}

/// The direction of a reflected ray.
fn reflect(dir: Vec3, normal: Vec3) -> Vec3 {
    dir - normal * (2.0 * dir.dot(normal))
}

/// The direction of a refracted ray, of unit length, and the cosine of its angle; none if all light
/// is reflected. `ratio` is the index of refraction where the ray is, by that where it goes; `cosine` is
/// that of the angle at which it arrives.
///
/// Source: Snell's law, in the form of Heckbert ("Writing a ray tracer", in Glassner, An Introduction to
/// Ray Tracing, 1989).
fn refract(dir: Vec3, normal: Vec3, cosine: f32, ratio: f32) -> Option<(Vec3, f32)> {
    if ratio == 1.0 {
        return Some((dir, cosine));
    }
    let square = 1.0 - ratio * ratio * (1.0 - cosine * cosine);
    if square < 0.0 {
        return None;
    }
    let behind = square.sqrt();
    let bent = dir * ratio + normal * (ratio * cosine - behind);
    Some((bent.normalize_or(dir), behind))
}

/// The share of unpolarised light that the border of two transparent media reflects, for the cosines
/// on both sides and the ratio as for [`refract`]. Source: Fresnel's equations.
fn fresnel(cosine: f32, behind: f32, ratio: f32) -> f32 {
    if ratio == 1.0 {
        return 0.0;
    }
    let part = |a: f32, b: f32| {
        let amplitude = (a - b) / (a + b);
        amplitude * amplitude
    };
    // Along a grazing ray both terms may vanish: all is reflected.
    let share = 0.5 * (part(ratio * cosine, behind) + part(cosine, ratio * behind));
    if share.is_finite() { share.min(1.0) } else { 1.0 }
}

/// The share that an opaque surface reflects: `straight` seen straight on, all at grazing angles.
/// Source: Schlick 1994.
fn schlick(straight: Vec3, cosine: f32) -> Vec3 {
    let off = 1.0 - cosine;
    let square = off * off;
    straight + (Vec3::ONE - straight).max(Vec3::ZERO) * (square * square * off)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at_angle(degrees: f64) -> (Vec3, f32) {
        let (sin, cos) = (libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians()));
        (Vec3::new(sin as f32, 0.0, -cos as f32), cos as f32)
    }

    #[test]
    fn light_bends_by_the_sines() {
        for degrees in [0.0, 10.0, 45.0, 80.0, 89.9] {
            let (dir, cosine) = at_angle(degrees);
            let (bent, behind) = refract(dir, Vec3::Z, cosine, 1.0 / 1.5).expect("into glass");
            let sine = libm::sin(degrees.to_radians()) / 1.5;
            assert!((f64::from(bent.x) - sine).abs() < 1e-6, "{degrees}: {bent}");
            assert!((f64::from(behind) - libm::sqrt(1.0 - sine * sine)).abs() < 1e-6);
            assert!(bent.z < 0.0 && (bent.length() - 1.0).abs() < 1e-6);
            // And back again, which along the surface hangs on the last digits.
            let (again, _) = refract(bent, Vec3::Z, behind, 1.5).expect("it came from there");
            assert!((again - dir).length() < 1e-4, "{degrees}: {again}");
        }
    }

    #[test]
    fn beyond_the_critical_angle_all_is_reflected() {
        // asin(1 / 1.5) = 41.81 degrees.
        for (degrees, leaves) in [(41.7, true), (41.9, false), (60.0, false)] {
            let (dir, cosine) = at_angle(degrees);
            assert_eq!(refract(dir, Vec3::Z, cosine, 1.5).is_some(), leaves, "{degrees}");
        }
    }

    #[test]
    fn fresnel_has_its_known_values() {
        // 4 % of glass seen straight on; nothing of parallel light at Brewster's angle, so half of
        // the other part.
        assert!((fresnel(1.0, 1.0, 1.0 / 1.5) - 0.04).abs() < 1e-6);
        assert!((fresnel(1.0, 1.0, 1.5) - 0.04).abs() < 1e-6);
        let brewster = libm::atan(1.5);
        let (cosine, behind) = (libm::cos(brewster) as f32, libm::sin(brewster) as f32);
        let perpendicular = (1.0 - 2.25f32) / (1.0 + 2.25);
        let want = 0.5 * perpendicular * perpendicular;
        assert!((fresnel(cosine, behind, 1.0 / 1.5) - want).abs() < 1e-6);
        assert_eq!(fresnel(0.0, 0.745, 1.0 / 1.5), 1.0);
        assert_eq!(schlick(Vec3::splat(0.2), 1.0), Vec3::splat(0.2));
        assert_eq!(schlick(Vec3::splat(0.2), 0.0), Vec3::ONE);
    }
}
