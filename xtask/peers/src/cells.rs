//! Speed: everyone on the same rays of one scene.

use serde::{Deserialize, Serialize};

use crate::check::Differences;
use crate::clock;
use crate::peers::{Built, Isa, Mode, Peer, Way};
use crate::race::Times;
use crate::rays::{Kind, Work};

/// By how much a way may be slower than its peer's fastest and still be timed more than once, if
/// time is short.
const FAR_BEHIND: f64 = 1.4;

/// All ways on the same rays of one scene.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Cell {
    pub(crate) scene: String,
    pub(crate) triangles: usize,
    /// Pixels along the side of the picture.
    pub(crate) size: u32,
    pub(crate) kind: Kind,
    pub(crate) isa: Isa,
    pub(crate) rows: Vec<Row>,
}

/// One way on some rays.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Row {
    pub(crate) mode: Mode,
    /// The end that rays start from, where there is a choice.
    pub(crate) order: String,
    pub(crate) rays: usize,
    /// The median of the rounds.
    pub(crate) seconds: f64,
    /// How many times as fast as our default.
    pub(crate) to_default: f64,
    /// From our default.
    pub(crate) differences: Differences,
    /// On one thread.
    pub(crate) build_seconds: f64,
    pub(crate) bytes: usize,
}

impl Row {
    pub(crate) fn mrays_per_s(&self) -> f64 {
        self.rays as f64 / self.seconds / 1e6
    }
}

impl Cell {
    /// The place of the fastest of some rows.
    pub(crate) fn fastest(&self, of: impl Fn(&Mode) -> bool) -> Option<usize> {
        fastest(&self.rows, of)
    }

    /// How many times as fast our default is as the fastest way of some.
    pub(crate) fn lead(&self, over: impl Fn(&Mode) -> bool) -> Option<f64> {
        self.fastest(over).map(|i| 1.0 / self.rows[i].to_default)
    }
}

fn fastest(rows: &[Row], of: impl Fn(&Mode) -> bool) -> Option<usize> {
    let places = (0..rows.len()).filter(|&i| of(&rows[i].mode));
    places.min_by(|&a, &b| rows[a].seconds.total_cmp(&rows[b].seconds))
}

/// A way, its rays, and what it took to be able to.
type Contestant<'a> = (Box<dyn Way + 'a>, &'a Work, Built);

/// Checks what everyone finds, then lets all ways race.
///
/// # Errors
/// If one of our own ways does not find, bit for bit, what our default finds.
pub(crate) fn measure(
    peers: &[Box<dyn Peer + '_>],
    works: &[Work],
    rounds: usize,
    quick: bool,
) -> Result<Vec<Row>, String> {
    let (mut contestants, mut rows) = (Vec::<Contestant>::new(), Vec::new());
    for work in works {
        let mut reference = None;
        for peer in peers {
            for mut way in peer.ways(work) {
                let built = peer.built();
                rows.push(first_run(&mut *way, work, built, &mut reference)?);
                contestants.push((way, work, built));
            }
        }
    }
    // All began alike: a second run is a fair first time.
    let mut run = |who: usize| {
        let way = &mut contestants[who].0;
        way.reset();
        clock::of_thread(|| way.run())
    };
    let mut racing: Vec<usize> = (0..rows.len()).collect();
    if quick {
        for (i, row) in rows.iter_mut().enumerate() {
            row.seconds = run(i);
        }
        let ahead = |row: &Row| {
            let best = fastest(&rows, |mode| mode.peer == row.mode.peer);
            let best = best.map_or(f64::INFINITY, |best| rows[best].seconds);
            row.mode.default || row.seconds < best * FAR_BEHIND
        };
        racing.retain(|&i| ahead(&rows[i]));
    }
    let times = Times::race(racing.len(), rounds, |who| run(racing[who]));
    for (who, &i) in racing.iter().enumerate() {
        rows[i].seconds = times.median(who);
    }
    // Rays may start from either end: our default takes the better.
    let default = fastest(&rows, |mode| mode.default).ok_or("our default is missing")?;
    let place = racing.iter().position(|&i| i == default).ok_or("our default did not race")?;
    let seconds = rows[default].seconds;
    for row in &mut rows {
        row.to_default = seconds / row.seconds;
    }
    for (who, &i) in racing.iter().enumerate() {
        rows[i].to_default = times.ratio(who, place);
    }
    Ok(rows)
}

/// Runs a way for the first time and compares what it finds with the reference: what the first way on
/// the same rays found, which is our default.
fn first_run(
    way: &mut dyn Way,
    work: &Work,
    built: Built,
    reference: &mut Option<Vec<Option<crate::peers::Hit>>>,
) -> Result<Row, String> {
    way.reset();
    way.run();
    let hits = way.hits();
    let mode = way.mode().clone();
    let expected = reference.get_or_insert_with(|| hits.clone());
    if mode.is_ours() && hits != *expected {
        let differing = hits.iter().zip(&*expected).filter(|(a, b)| a != b).count();
        return Err(format!("{}: {differing} hits are not those of the default", mode.name));
    }
    Ok(Row {
        mode,
        order: work.order.to_owned(),
        rays: work.rays.len(),
        seconds: 0.0,
        to_default: 0.0,
        differences: Differences::between(&work.rays, &hits, expected),
        build_seconds: built.took.on(1),
        bytes: built.bytes,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::clock::Took;
    use crate::peers::Hit;
    use glam::Vec3;
    use rt_kernels::Ray;

    /// Finds what it is told to find.
    struct Fake {
        mode: Mode,
        found: Vec<Option<Hit>>,
    }

    struct Running<'a>(&'a Fake);

    impl Way for Running<'_> {
        fn mode(&self) -> &Mode {
            &self.0.mode
        }

        fn run(&mut self) {}

        fn hits(&self) -> Vec<Option<Hit>> {
            self.0.found.clone()
        }
    }

    impl Peer for Fake {
        fn built(&self) -> Built {
            Built { took: Took::default(), bytes: 7 }
        }

        fn ways<'a>(&'a self, _: &'a Work) -> Vec<Box<dyn Way + 'a>> {
            vec![Box::new(Running(self))]
        }
    }

    fn fake(peer: &str, default: bool, prim: u32) -> Box<dyn Peer> {
        let mode = Mode { peer: peer.to_owned(), name: String::new(), default };
        Box::new(Fake { mode, found: vec![Some(Hit { t: prim as f32, prim }), None] })
    }

    fn work() -> Work {
        Work { kind: Kind::Primary, order: "", rays: vec![Ray::new(Vec3::ZERO, Vec3::X); 2] }
    }

    #[test]
    fn others_may_differ_and_are_counted() {
        let peers = [fake("rt", true, 1), fake("rt", false, 1), fake("embree4", false, 2)];
        let rows = measure(&peers, &[work()], 3, false).expect("ours agree");
        let other: Vec<_> = rows.iter().map(|row| row.differences.other).collect();
        assert_eq!((other, rows[2].bytes, rows[0].rays), (vec![0, 0, 1], 7, 2));
    }

    #[test]
    fn ours_may_not() {
        let peers = [fake("rt", true, 1), fake("rt", false, 2)];
        let wrong = measure(&peers, &[work()], 3, false).expect_err("they differ");
        assert!(wrong.contains("1 hits"), "{wrong}");
    }
}
