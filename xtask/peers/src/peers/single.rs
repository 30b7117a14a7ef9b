//! Crates that trace ray after ray.

use std::marker::PhantomData;

use rt_kernels::Ray;

use super::{Built, Hit, Mode, Peer, Way};
use crate::rays::Work;

/// A hierarchy of a crate's.
pub(super) trait Tracer {
    /// The crate, and what of it.
    const NAME: [&str; 2];

    /// A ray as it takes it.
    type Ray;

    fn ray(ray: &Ray) -> Self::Ray;

    /// The closest hit.
    fn closest(&self, ray: &Self::Ray) -> Option<Hit>;

    /// Whether there is any.
    fn any(&self, ray: &Self::Ray) -> bool;
}

/// One that is built.
pub(super) struct Single<T> {
    pub(super) tracer: T,
    pub(super) built: Built,
}

impl<T: Tracer> Peer for Single<T> {
    fn built(&self) -> Built {
        self.built
    }

    fn ways<'a>(&'a self, work: &'a Work) -> Vec<Box<dyn Way + 'a>> {
        let [peer, name] = T::NAME;
        let (mode, rays) = (Mode::of(peer, name), work.rays.iter().map(T::ray).collect());
        let hits = vec![None; work.rays.len()];
        let tracer = &self.tracer;
        if work.kind.closest() {
            vec![Box::new(Run::<_, Closest> { mode, tracer, rays, hits, query: PhantomData })]
        } else {
            vec![Box::new(Run::<_, Any> { mode, tracer, rays, hits, query: PhantomData })]
        }
    }
}

/// What is asked for.
trait Query {
    fn ask<T: Tracer>(tracer: &T, ray: &T::Ray) -> Option<Hit>;
}

struct Closest;

impl Query for Closest {
    fn ask<T: Tracer>(tracer: &T, ray: &T::Ray) -> Option<Hit> {
        tracer.closest(ray)
    }
}

struct Any;

impl Query for Any {
    fn ask<T: Tracer>(tracer: &T, ray: &T::Ray) -> Option<Hit> {
        tracer.any(ray).then_some(Hit::SOME)
    }
}

/// Its way to trace some rays.
struct Run<'a, T: Tracer, Q> {
    mode: Mode,
    tracer: &'a T,
    rays: Vec<T::Ray>,
    hits: Vec<Option<Hit>>,
    query: PhantomData<Q>,
}

impl<T: Tracer, Q: Query> Way for Run<'_, T, Q> {
    fn mode(&self) -> &Mode {
        &self.mode
    }

    fn run(&mut self) {
        for (ray, hit) in self.rays.iter().zip(&mut self.hits) {
            *hit = Q::ask(self.tracer, ray);
        }
    }

    fn hits(&self) -> Vec<Option<Hit>> {
        self.hits.clone()
    }
}
