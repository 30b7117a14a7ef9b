//! Phong's reflection model: for one point, and for as many as there are lanes.

use glam::Vec3;
use rt_kernels::{Exec, PacketSize};
use simd4::prelude::*;
use simd4::{dispatch, math, scalar};

use super::Finish;
use super::points::{Lit, Points};
use crate::exec::PointLight;

/// The light that a surface sends back to where a ray came from, of a light of intensity 1: per
/// colour, for unit vectors `normal`, `to_light` and the ray's direction `dir`.
///
/// Source: Phong 1975.
pub(crate) fn phong(finish: &Finish, normal: Vec3, to_light: Vec3, dir: Vec3) -> Vec3 {
    let cosine = normal.dot(to_light);
    if cosine <= 0.0 {
        return Vec3::ZERO;
    }
    let reflected = normal * (2.0 * cosine) - to_light;
    let highlight = (-dir).dot(reflected).clamp(0.0, 1.0);
    let power = simd4::scalar::f32x1::from([highlight]).pow([finish.shininess].into());
    finish.diffuse * cosine + finish.specular * power.to_array()[0]
}

/// For every point the direction and distance of a light, and what it adds if nothing is in the way:
/// zero where the light is behind the surface. The points of all materials go through together: each
/// lane has its own.
///
/// Single rays have single points; else there are as many as the level has lanes. The bits do not
/// depend on it, unless `relaxed`: see [`Job::relaxed`](crate::Job::relaxed).
///
/// Source: Wald, Slusallek, Benthin and Wagner 2001, Section 5. Deviations: (1) what lights add is
/// computed before it is known whether they are visible, so that no shadow ray is sent where they add
/// nothing; (2) points are rearranged into lanes once for all lights; (3) any number of lanes.
pub(crate) fn light(exec: Exec, relaxed: bool, points: &Points, light: &PointLight, lit: &mut Lit) {
    lit.resize(points.len());
    match (exec.packet, relaxed) {
        (PacketSize::Single, _) => {
            in_lanes::<scalar::f32x1, false>(simd4::Scalar::new(), points, light, lit);
        }
        (_, false) => dispatch!(exec.level, s => native::<false, _>(s, points, light, lit)),
        (_, true) => dispatch!(exec.level, s => native::<true, _>(s, points, light, lit)),
    }
}

#[inline(always)]
fn native<const RELAXED: bool, S: Simd>(s: S, points: &Points, light: &PointLight, lit: &mut Lit) {
    in_lanes::<S::f32s, RELAXED>(s, points, light, lit);
}

#[inline(always)]
fn in_lanes<V: SimdF32, const RELAXED: bool>(
    s: V::Simd,
    points: &Points,
    light: &PointLight,
    lit: &mut Lit,
) {
    let (zero, one) = (V::splat(s, 0.0), V::splat(s, 1.0));
    let position = math::Vec3::splat(s, light.position.to_array());
    let [red, green, blue] = light.color.to_array().map(|channel| V::splat(s, channel));
    let mut i = 0;
    while i < points.len() {
        let towards = position - vector(s, &points.leave, i);
        let (distance, to_light) = if RELAXED {
            let squared: V = towards.dot(towards);
            let inverse = squared.rsqrt_fast();
            (squared * inverse, towards * inverse)
        } else {
            let distance = towards.length();
            (distance, towards * (one / distance))
        };
        let true_normal = vector::<V>(s, &points.true_normal, i);
        let normal = vector::<V>(s, &points.normal, i);
        let cosine = normal.dot(to_light);
        // Also false for the NaN of a light on the very spot.
        let faces = true_normal.dot(to_light).gt(zero) & cosine.gt(zero);

        let reflected = normal * (cosine + cosine) - to_light;
        let highlight = zero - vector::<V>(s, &points.dir, i).dot(reflected);
        let highlight = highlight.max(zero).min(one);
        let shininess = V::load(s, &points.shininess[i..]);
        let power = if RELAXED {
            // 0 to the power 0 is 1, and 0 times the logarithm of 0 no number.
            let power = (highlight.log2() * shininess).exp2();
            V::select(shininess.eq(zero), one, power)
        } else {
            highlight.pow(shininess)
        };
        let sent = vector(s, &points.diffuse, i) * cosine + vector(s, &points.specular, i) * power;
        let added = math::Vec3::new(sent.x * red, sent.y * green, sent.z * blue);
        store(math::Vec3::select(faces, added, math::Vec3::splat(s, [0.0; 3])), &mut lit.added, i);
        store(to_light, &mut lit.to_light, i);
        distance.store(&mut lit.distance[i..]);
        i += V::LANES;
    }
}

#[inline(always)]
fn vector<V: SimdF32>(s: V::Simd, [x, y, z]: &[Vec<f32>; 3], i: usize) -> math::Vec3<V> {
    math::Vec3::new(V::load(s, &x[i..]), V::load(s, &y[i..]), V::load(s, &z[i..]))
}

#[inline(always)]
fn store<V: SimdF32>(vector: math::Vec3<V>, [x, y, z]: &mut [Vec<f32>; 3], i: usize) {
    vector.x.store(&mut x[i..]);
    vector.y.store(&mut y[i..]);
    vector.z.store(&mut z[i..]);
}
