//! The same functions by hand: what somebody writes who knows one level's intrinsics and has only
//! that level. They keep the same contract, NaNs, saturation and order of additions, in loops of
//! the same shape. One file a level; a new level is a file and a line in [`of`]. What two
//! levels share of their registers has one too.

use crate::io::Io;

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod sse2;
#[cfg(target_arch = "x86_64")]
mod sse41;
#[cfg(target_arch = "x86_64")]
mod xmm;

/// To be called where the CPU has the level.
pub(crate) type Twin = unsafe fn(&mut Io);

type Table = &'static [(&'static str, Twin)];

/// The twin of an op or a kernel, of the level of that name, if somebody wrote it.
pub(crate) fn of(level: &str, name: &str) -> Option<Twin> {
    let tables: &[Table] = match level {
        #[cfg(target_arch = "x86_64")]
        "sse2" => &[sse2::TWINS],
        // What has no better instruction there is SSE2's.
        #[cfg(target_arch = "x86_64")]
        "sse4.1" => &[sse41::TWINS, sse2::TWINS],
        #[cfg(target_arch = "x86_64")]
        "avx2" => &[avx2::TWINS],
        _ => &[],
    };
    tables.iter().copied().flatten().find(|(of, _)| *of == name).map(|(_, twin)| *twin)
}

/// Defines twins: ops in loops over rows as [`crate::ops`] has them, with the `Regs` and the
/// stores of the file, and the table of these and of the
/// functions that stand there in full.
macro_rules! twins {
    (
        $features:literal;
        in_full: $($full:ident)*;
        $($name:ident = $shape:ident |$r:ident| $body:expr;)*
    ) => {
        $(
            #[target_feature(enable = $features)]
            fn $name(io: &mut Io) {
                twins!(@$shape io, $r, $body)
            }
        )*
        pub(super) const TWINS: &[(&str, Twin)] =
            &[$((stringify!($name), $name as Twin),)* $((stringify!($full), $full as Twin)),*];
    };
    (@map $io:ident, $r:ident, $body:expr) => {
        for at in (0..N).step_by(LANES) {
            let $r = Regs::load($io, at);
            store_epi32(&mut $io.bits.0, at, $body);
        }
    };
    (@pair $io:ident, $r:ident, $body:expr) => {
        for at in (0..N).step_by(LANES) {
            let $r = Regs::load($io, at);
            let (x, y) = $body;
            store(&mut $io.floats.0, at, x);
            store(&mut $io.floats.0, N + at, y);
        }
    };
    (@reduce $io:ident, $r:ident, $body:expr) => {
        for k in 0..N / LANES {
            let $r = Regs::load($io, k * LANES);
            $io.floats.0[k] = $body;
        }
    };
    (@fold $io:ident, $r:ident, $body:expr) => {
        for k in 0..N / LANES {
            let $r = Regs::load($io, k * LANES);
            $io.bits.0[k] = $body;
        }
    };
}
use twins;
