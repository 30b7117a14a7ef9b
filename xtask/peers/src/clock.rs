//! Time, as far as others on the machine do not take it.

use std::time::{Duration, Instant};

use rustix::time::{ClockId, clock_gettime};

/// How long something took, in seconds.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Took {
    /// All threads of this program had processors, together.
    pub(crate) processor: f64,
    /// That passed.
    pub(crate) wall: f64,
}

impl Took {
    /// What counts for something that runs on that many threads.
    pub(crate) fn on(self, threads: usize) -> f64 {
        if threads == 1 { self.processor } else { self.wall }
    }
}

/// Times what may run on other threads than this.
pub(crate) fn took<R>(run: impl FnOnce() -> R) -> (R, Took) {
    let (processor, wall) = (now(ClockId::ProcessCPUTime), Instant::now());
    let result = run();
    let wall = wall.elapsed().as_secs_f64();
    (result, Took { processor: (now(ClockId::ProcessCPUTime) - processor).as_secs_f64(), wall })
}

/// The seconds for which this thread has a processor meanwhile.
pub(crate) fn of_thread(run: impl FnOnce()) -> f64 {
    let start = now(ClockId::ThreadCPUTime);
    run();
    (now(ClockId::ThreadCPUTime) - start).as_secs_f64()
}

fn now(clock: ClockId) -> Duration {
    let time = clock_gettime(clock);
    Duration::new(time.tv_sec as u64, time.tv_nsec as u32)
}
