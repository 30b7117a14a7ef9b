//! Accesses to memory and cache misses, counted by a simulator: valgrind's cachegrind, which runs this
//! program again.

use std::process::Command;

use rt_render::measure::Extent;
use serde_json::{Value, json};

use crate::error::Error;

pub(super) const HEAD: &str = "
misses of a frame in millions, simulated by cachegrind: the whole picture in three stages (paper), and
tile at a time
                     first level: picture     tile   last level: picture     tile
";

/// Of frames alone: what it took to build the scene is taken off.
pub(super) struct Compared {
    scene: String,
    picture: [f64; 2],
    tile: [f64; 2],
}

/// Makes a frame each way in the simulator.
pub(super) fn compare(scene: &str, size: (u32, u32)) -> Result<Compared, Error> {
    let without = frame(scene, None, size)?;
    let frame = |extent| {
        let with = frame(scene, Some(extent), size)?;
        Ok::<_, Error>([with.first - without.first, with.last - without.last])
    };
    let (picture, tile) = (frame(Extent::Picture)?, frame(Extent::Tile)?);
    Ok(Compared { scene: format!("spd:{scene}"), picture, tile })
}

impl Compared {
    pub(super) fn line(&self) -> String {
        let Compared { scene, picture, tile } = self;
        let [p1, pl, t1, tl] = [picture[0], picture[1], tile[0], tile[1]].map(|count| count / 1e6);
        format!("  {scene:<18}{p1:>21.3}{t1:>9.3}{pl:>22.3}{tl:>9.3}\n")
    }

    pub(super) fn json(&self) -> [Value; 2] {
        [(Extent::Picture, self.picture), (Extent::Tile, self.tile)].map(
            |(extent, [first, last])| {
                json!({
                    "what": "misses",
                    "scene": self.scene,
                    "extent": extent.name(),
                    "first_level": first,
                    "last_level": last,
                })
            },
        )
    }
}

fn frame(
    scene: &str,
    extent: Option<Extent>,
    (width, height): (u32, u32),
) -> Result<Counts, Error> {
    let size = format!("{width}x{height}");
    let frame = format!("{scene},{}", extent.map_or("none", Extent::name));
    simulate(&["paper", "geimer-mueller", "--size", &size, "--frame", &frame], None)
}

/// Sizes of caches of data, as `--D1` and `--LL` have them: bytes, ways, bytes a line.
#[derive(Clone, Copy)]
pub(super) struct Caches([&'static str; 2]);

/// As the Pentium III at 800 MHz had them.
pub(super) const PENTIUM_III: Caches = Caches(["16384,4,32", "262144,8,32"]);

/// As a core of today has for itself.
pub(super) const TODAY: Caches = Caches(["32768,8,64", "1048576,16,64"]);

/// What a run of this program did to memory.
#[derive(Clone, Copy)]
pub(super) struct Counts {
    pub(super) accesses: f64,
    /// Misses of data in the first and the last level of caches.
    pub(super) first: f64,
    pub(super) last: f64,
}

/// Runs this program in the simulator, with those caches or with this machine's.
pub(super) fn simulate(args: &[&str], caches: Option<Caches>) -> Result<Counts, Error> {
    let failed = |why: String| Error::Cachegrind(why);
    let this = std::env::current_exe().map_err(|error| failed(error.to_string()))?;
    let caches =
        caches.map(|Caches([first, last])| [format!("--D1={first}"), format!("--LL={last}")]);
    let run = Command::new("valgrind")
        .args(["--tool=cachegrind", "--cache-sim=yes", "--cachegrind-out-file=/dev/null"])
        .args(caches.into_iter().flatten())
        .arg(this)
        .args(args)
        .output()
        .map_err(|error| failed(format!("cannot run valgrind: {error}")))?;
    let talk = String::from_utf8_lossy(&run.stderr);
    if !run.status.success() {
        return Err(failed(talk.into_owned()));
    }
    let count = |what: &str| parse(&talk, what).ok_or_else(|| failed(format!("{what}?\n{talk}")));
    Ok(Counts {
        accesses: count("D   refs:")?,
        first: count("D1  misses:")?,
        last: count("LLd misses:")?,
    })
}

/// The number after some words: `==1== D1  misses:  1,234  ( 1,000 rd  + 234 wr)`.
fn parse(talk: &str, what: &str) -> Option<f64> {
    let line = talk.lines().find_map(|line| line.split_once(what))?;
    let number: String = line.1.trim_start().chars().take_while(|&c| c != ' ').collect();
    number.replace(',', "").parse().ok()
}

#[cfg(test)]
mod tests {
    use super::parse;

    #[test]
    fn counts_are_read() {
        let talk = "==1== D   refs:  9\n==1== D1  misses:      1,234,567  ( 1,000 rd   + 234 wr)\n";
        assert_eq!(parse(talk, "D   refs:"), Some(9.0));
        assert_eq!(parse(talk, "D1  misses:"), Some(1_234_567.0));
        assert_eq!(parse(talk, "LLd misses:"), None);
    }
}
