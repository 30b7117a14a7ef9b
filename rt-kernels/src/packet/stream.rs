//! Rays and hits in memory, component by component (SoA), so that any packet size loads them
//! without shuffling.

use glam::Vec3;

use crate::{Hit, Ray};

/// A batch of rays. Neighbours share packets: the more alike they are, the faster it goes. The
/// hits do not depend on it.
#[derive(Clone, Debug, Default)]
pub struct Rays {
    /// Origin x, y, z; direction x, y, z; tmin; tmax.
    components: [Vec<f32>; 8],
}

impl Rays {
    /// No rays.
    pub fn new() -> Self {
        Rays::default()
    }

    /// Adds a ray.
    pub fn push(&mut self, ray: Ray) {
        let (o, d) = (ray.origin, ray.dir);
        let values = [o.x, o.y, o.z, d.x, d.y, d.z, ray.tmin, ray.tmax];
        for (component, value) in self.components.iter_mut().zip(values) {
            component.push(value);
        }
    }

    /// Removes all rays and keeps the memory.
    pub fn clear(&mut self) {
        self.components.iter_mut().for_each(Vec::clear);
    }

    /// The number of rays.
    pub fn len(&self) -> usize {
        self.components[0].len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The ray of that number.
    ///
    /// # Panics
    /// If there is none.
    #[inline(always)]
    pub fn get(&self, i: usize) -> Ray {
        let [ox, oy, oz, dx, dy, dz, tmin, tmax] = &self.components;
        let [origin, dir] = [[ox, oy, oz], [dx, dy, dz]];
        Ray { origin: at(origin, i), dir: at(dir, i), tmin: tmin[i], tmax: tmax[i] }
    }

    /// Becomes the rays of another batch at these places.
    pub(super) fn gather(&mut self, from: &Rays, places: &[u32]) {
        for (to, from) in self.components.iter_mut().zip(&from.components) {
            to.clear();
            to.extend(places.iter().map(|&place| from[place as usize]));
        }
    }

    /// All components of so many rays from `first` on.
    #[inline(always)]
    pub(super) fn part(&self, first: usize, count: usize) -> [&[f32]; 8] {
        let [a, b, c, d, e, f, g, h] = &self.components;
        let rays = first..first + count;
        [
            &a[rays.clone()],
            &b[rays.clone()],
            &c[rays.clone()],
            &d[rays.clone()],
            &e[rays.clone()],
            &f[rays.clone()],
            &g[rays.clone()],
            &h[rays],
        ]
    }
}

#[inline(always)]
fn at([x, y, z]: [&Vec<f32>; 3], i: usize) -> Vec3 {
    Vec3::new(x[i], y[i], z[i])
}

impl FromIterator<Ray> for Rays {
    fn from_iter<I: IntoIterator<Item = Ray>>(iter: I) -> Self {
        let mut rays = Rays::new();
        rays.extend(iter);
        rays
    }
}

impl Extend<Ray> for Rays {
    fn extend<I: IntoIterator<Item = Ray>>(&mut self, iter: I) {
        iter.into_iter().for_each(|ray| self.push(ray));
    }
}

/// The closest hits of a batch of rays, in the order of the rays.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Hits {
    pub(super) t: Vec<f32>,
    pub(super) u: Vec<f32>,
    pub(super) v: Vec<f32>,
    pub(super) prim: Vec<u32>,
}

impl Hits {
    /// The number of a primitive that stands for none.
    pub(crate) const NONE: u32 = u32::MAX;

    /// No hits.
    pub fn new() -> Self {
        Hits::default()
    }

    /// The number of rays that were traced.
    pub fn len(&self) -> usize {
        self.prim.len()
    }

    /// Whether none were.
    pub fn is_empty(&self) -> bool {
        self.prim.is_empty()
    }

    /// What the ray of that number hit.
    ///
    /// # Panics
    /// If no ray of that number was traced.
    pub fn get(&self, i: usize) -> Option<Hit> {
        let prim = self.prim[i];
        (prim != Hits::NONE).then(|| Hit { t: self.t[i], prim, u: self.u[i], v: self.v[i] })
    }

    /// Writes for every ray whether it hit anything.
    pub(crate) fn found(&self, found: &mut Vec<bool>) {
        found.clear();
        found.extend(self.prim.iter().map(|&prim| prim != Hits::NONE));
    }

    /// States the hit of a ray; none if its number is [`Hits::NONE`].
    #[inline(always)]
    pub(crate) fn set(&mut self, i: usize, hit: Hit) {
        (self.t[i], self.u[i], self.v[i], self.prim[i]) = (hit.t, hit.u, hit.v, hit.prim);
    }

    /// Takes what a ray has found later, if it is better than what it has.
    #[inline(always)]
    pub(crate) fn take(&mut self, i: usize, hit: Hit) {
        let (t, prim) = (self.t[i], self.prim[i]);
        if hit.wins(&Hit { t, prim, u: 0.0, v: 0.0 }) {
            self.set(i, hit);
        }
    }

    /// Makes room for `n` rays.
    pub(crate) fn resize(&mut self, n: usize) {
        self.t.resize(n, 0.0);
        self.u.resize(n, 0.0);
        self.v.resize(n, 0.0);
        self.prim.resize(n, Hits::NONE);
    }
}
