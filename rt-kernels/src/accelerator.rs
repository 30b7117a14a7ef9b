//! What can be asked of an acceleration structure.

use std::cmp::Ordering;

use crate::packet::{Hits, Rays};
use crate::{Exec, Hit, Ray, Stats};

/// What is done with a hit: it returns the greatest `t` that still matters.
pub(crate) type Visitor<'a> = &'a mut dyn FnMut(Hit) -> f32;

/// What finds hits: an acceleration structure, or none.
pub trait Accelerator: Send + Sync {
    /// Finds the closest hit of every ray. `hits` is made as long as `rays`; work is added to
    /// `stats`.
    ///
    /// The rays may be in any order, and go anywhere: those that go together are found here. Which they
    /// are and how many, changes no hit.
    ///
    /// ```
    /// # use glam::Vec3;
    /// # use rt_kernels::{Accelerator, Bvh, Exec, Hits, PacketSize, Primitives, Ray, Rays};
    /// # use rt_kernels::{Sequential, Stats, geom::Sphere};
    /// # let spheres = vec![Sphere { center: Vec3::ZERO, radius: 1.0 }];
    /// # let bvh = Bvh::build(&Primitives { spheres, ..Primitives::default() }, &Sequential)?;
    /// let rays: Rays = (0..100)
    ///     .map(|i| Ray::new(Vec3::new(i as f32 / 50.0, 0.0, 5.0), Vec3::NEG_Z))
    ///     .collect();
    /// let (mut hits, mut stats) = (Hits::new(), Stats::default());
    /// bvh.closest(Exec::best()?, &rays, &mut hits, &mut stats);
    /// assert_eq!((hits.get(0).map(|hit| hit.t), hits.get(99)), (Some(4.0), None));
    ///
    /// let mut by_fours = Hits::new();
    /// let exec = Exec { packet: PacketSize::Four, ..Exec::best()? };
    /// bvh.closest(exec, &rays, &mut by_fours, &mut stats);
    /// assert!(by_fours == hits);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    fn closest(&self, exec: Exec, rays: &Rays, hits: &mut Hits, stats: &mut Stats);

    /// Finds for every ray whether it hits anything within its interval. `found` is made as long
    /// as `rays`; work is added to `stats`.
    ///
    /// ```
    /// # use glam::Vec3;
    /// # use rt_kernels::{Accelerator, Bvh, Exec, Primitives, Ray, Rays, Sequential, Stats};
    /// # use rt_kernels::geom::Sphere;
    /// # let spheres = vec![Sphere { center: Vec3::ZERO, radius: 1.0 }];
    /// # let bvh = Bvh::build(&Primitives { spheres, ..Primitives::default() }, &Sequential)?;
    /// // Shadow rays: from a lamp to points before the ball, behind it and beside it.
    /// let lamp = Vec3::new(0.0, 0.0, 5.0);
    /// let points = [Vec3::Z * 2.0, Vec3::Z * -2.0, Vec3::X * 2.0];
    /// let rays: Rays = points
    ///     .map(|point| Ray { tmax: 1.0, ..Ray::new(lamp, point - lamp) })
    ///     .into_iter()
    ///     .collect();
    /// let mut dark = Vec::new();
    /// bvh.any(Exec::best()?, &rays, &mut dark, &mut Stats::default());
    /// assert_eq!(dark, [false, true, false]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    fn any(&self, exec: Exec, rays: &Rays, found: &mut Vec<bool>, stats: &mut Stats);

    /// Shows `visitor` what a ray hits, in no order, and a hit perhaps twice. It returns the
    /// greatest `t` that still matters: of later hits only those up to it are shown. A negative
    /// one ends the search.
    ///
    /// ```
    /// # use glam::Vec3;
    /// # use rt_kernels::{Accelerator, Bvh, Primitives, Ray, Sequential, geom::Sphere};
    /// # let ball = |z| Sphere { center: Vec3::new(0.0, 0.0, z), radius: 1.0 };
    /// # let spheres = vec![ball(0.0), ball(-5.0)];
    /// # let bvh = Bvh::build(&Primitives { spheres, ..Primitives::default() }, &Sequential)?;
    /// let ray = Ray::new(Vec3::new(0.0, 0.0, 5.0), Vec3::NEG_Z);
    /// let mut hit = [false; 2];
    /// bvh.visit(&ray, &mut |found| {
    ///     hit[found.prim as usize] = true;
    ///     ray.tmax
    /// });
    /// assert_eq!(hit, [true; 2]);
    /// # Ok::<(), rt_kernels::BuildError>(())
    /// ```
    fn visit(&self, ray: &Ray, visitor: &mut dyn FnMut(Hit) -> f32);

    /// The closest hit of one ray. A batch ([`closest`](Accelerator::closest)) is quicker.
    ///
    /// ```
    /// # use glam::Vec3;
    /// # use rt_kernels::{Accelerator, Bvh, Primitives, Ray, Sequential, geom::Triangle};
    /// let floor = Triangle { corners: [Vec3::ZERO, Vec3::X * 4.0, Vec3::Z * 4.0] };
    /// let scene = Primitives { triangles: vec![floor], ..Primitives::default() };
    /// let bvh = Bvh::build(&scene, &Sequential)?;
    ///
    /// let ray = Ray::new(Vec3::new(1.0, 3.0, 2.0), Vec3::NEG_Y);
    /// let hit = bvh.intersect(&ray).expect("it is above the floor");
    /// assert_eq!((hit.t, hit.u, hit.v), (3.0, 0.25, 0.5));
    /// # Ok::<(), rt_kernels::BuildError>(())
    /// ```
    fn intersect(&self, ray: &Ray) -> Option<Hit> {
        self.intersect_where(ray, &mut |_| true)
    }

    /// The closest hit of one ray among those that `keep` says yes to: a primitive filter.
    ///
    /// `keep` may be asked about a hit twice, and about hits that are not the closest.
    ///
    /// ```
    /// # use glam::Vec3;
    /// # use rt_kernels::{Accelerator, Bvh, Primitives, Ray, Sequential, geom::Sphere};
    /// # let ball = |z| Sphere { center: Vec3::new(0.0, 0.0, z), radius: 1.0 };
    /// # let spheres = vec![ball(0.0), ball(-5.0)];
    /// # let bvh = Bvh::build(&Primitives { spheres, ..Primitives::default() }, &Sequential)?;
    /// let ray = Ray::new(Vec3::new(0.0, 0.0, 5.0), Vec3::NEG_Z);
    /// let behind = bvh.intersect_where(&ray, &mut |hit| hit.prim != 0).expect("two balls");
    /// assert_eq!((behind.prim, behind.t), (1, 9.0));
    /// # Ok::<(), rt_kernels::BuildError>(())
    /// ```
    fn intersect_where(&self, ray: &Ray, keep: &mut dyn FnMut(&Hit) -> bool) -> Option<Hit> {
        let mut closest: Option<Hit> = None;
        self.visit(ray, &mut |hit| {
            if closest.is_none_or(|best| hit.wins(&best)) && keep(&hit) {
                closest = Some(hit);
            }
            closest.map_or(f32::INFINITY, |best| best.t)
        });
        closest
    }

    /// Whether one ray hits anything within its interval; the search ends with the first hit.
    ///
    /// ```
    /// # use glam::Vec3;
    /// # use rt_kernels::{Accelerator, Bvh, Primitives, Ray, Sequential, geom::Sphere};
    /// # let spheres = vec![Sphere { center: Vec3::ZERO, radius: 1.0 }];
    /// # let bvh = Bvh::build(&Primitives { spheres, ..Primitives::default() }, &Sequential)?;
    /// let toward = Ray::new(Vec3::new(0.0, 0.0, 5.0), Vec3::NEG_Z);
    /// assert!(bvh.occluded(&toward));
    /// assert!(!bvh.occluded(&Ray { tmax: 3.5, ..toward }));
    /// # Ok::<(), rt_kernels::BuildError>(())
    /// ```
    fn occluded(&self, ray: &Ray) -> bool {
        let mut found = false;
        self.visit(ray, &mut |_| {
            found = true;
            f32::NEG_INFINITY
        });
        found
    }

    /// All hits along one ray, the closest of each primitive, in increasing order of
    /// `(t, primitive)`.
    ///
    /// ```
    /// # use glam::Vec3;
    /// # use rt_kernels::{Accelerator, Bvh, Primitives, Ray, Sequential, geom::Sphere};
    /// # let ball = |z| Sphere { center: Vec3::new(0.0, 0.0, z), radius: 1.0 };
    /// # let spheres = vec![ball(-5.0), ball(0.0)];
    /// # let bvh = Bvh::build(&Primitives { spheres, ..Primitives::default() }, &Sequential)?;
    /// let ray = Ray::new(Vec3::new(0.0, 0.0, 5.0), Vec3::NEG_Z);
    /// let all: Vec<_> = bvh.all_hits(&ray).iter().map(|hit| (hit.t, hit.prim)).collect();
    /// assert_eq!(all, [(4.0, 1), (9.0, 0)]);
    /// # Ok::<(), rt_kernels::BuildError>(())
    /// ```
    fn all_hits(&self, ray: &Ray) -> Vec<Hit> {
        let mut hits = Vec::new();
        self.visit(ray, &mut |hit| {
            hits.push(hit);
            f32::INFINITY
        });
        // By value, as for the closest: -0 is 0, and `t` is never NaN.
        let order = |a: &Hit, b: &Hit| (a.t, a.prim).partial_cmp(&(b.t, b.prim));
        hits.sort_by(|a, b| order(a, b).unwrap_or(Ordering::Equal));
        // Where a builder cuts, a primitive is in several leaves.
        hits.dedup_by_key(|hit| hit.prim);
        hits
    }

    /// What a choice comes to here: not everything has code for packets of any size.
    fn exec(&self, asked: Exec) -> Exec;

    /// The memory that the structure and its copy of the primitives take.
    fn bytes(&self) -> usize;
}
