//! Tables of what was measured.

use std::fmt::Write;

use crate::check::Differences;
use crate::peer::{Built, Isa, Mode};
use crate::race::geometric_mean;
use crate::rays::Kind;

/// One way on some rays.
pub(crate) struct Row {
    pub(crate) mode: Mode,
    pub(crate) built: Built,
    pub(crate) rays: usize,
    /// From our default.
    pub(crate) differences: Differences,
    pub(crate) seconds: f64,
    /// How many times as fast as our default.
    pub(crate) to_default: f64,
}

impl Row {
    pub(crate) fn mrays_per_s(&self) -> f64 {
        self.rays as f64 / self.seconds / 1e6
    }
}

/// All ways on the same rays of one scene.
pub(crate) struct Cell {
    pub(crate) scene: String,
    pub(crate) triangles: usize,
    pub(crate) size: u32,
    pub(crate) kind: Kind,
    pub(crate) isa: Isa,
    pub(crate) rows: Vec<Row>,
}

/// The place of the fastest row of some.
pub(crate) fn fastest(rows: &[Row], of: impl Fn(&Row) -> bool) -> Option<usize> {
    let places = (0..rows.len()).filter(|&i| of(&rows[i]));
    places.min_by(|&a, &b| rows[a].seconds.total_cmp(&rows[b].seconds))
}

fn is_embree(row: &Row) -> bool {
    row.mode.peer.starts_with("embree")
}

/// The columns of a cell's table.
pub(crate) fn head() -> String {
    format!(
        "{:<11} {:>4} {:<7} {:<6} {:<7} {:<36}{:>8} {:>9} {:>8} {:>6} {:>7} {:>6} {:>6} {:>6}\n",
        "scene",
        "size",
        "rays",
        "isa",
        "peer",
        "way",
        "Mray/s",
        "× default",
        "build s",
        "B/tri",
        "missed",
        "extra",
        "other",
        "moved",
    )
}

impl Cell {
    /// Our default by Embree's fastest way: how many times as fast.
    pub(crate) fn lead(&self) -> Option<f64> {
        fastest(&self.rows, is_embree).map(|i| 1.0 / self.rows[i].to_default)
    }

    /// Its rows; if `brief` only our default and the fastest of each peer.
    pub(crate) fn table(&self, brief: bool) -> String {
        let mut table = String::new();
        for (i, row) in self.rows.iter().enumerate() {
            let best = fastest(&self.rows, |other| other.mode.peer == row.mode.peer) == Some(i);
            if brief && !best && !row.mode.default {
                continue;
            }
            let Cell { scene, size, kind, isa, .. } = self;
            let (kind, Mode { peer, .. }, d) = (kind.name(), &row.mode, row.differences);
            let mark = if best { "*" } else { " " };
            let bytes = row.built.bytes as f64 / self.triangles as f64;
            let _ = writeln!(
                table,
                "{scene:<11} {size:>4} {kind:<7} {isa:<6} {peer:<7} {:<36}{:>7.2}{mark} {:>9.3} {:>8.3} {bytes:>6.1} {:>7} {:>6} {:>6} {:>6}",
                row.mode,
                row.mrays_per_s(),
                row.to_default,
                row.built.time.as_secs_f64(),
                d.missed,
                d.extra,
                d.other,
                d.moved,
            );
        }
        table
    }
}

/// Geometric means over the scenes, our default by Embree's fastest way.
pub(crate) fn summary(cells: &[Cell]) -> String {
    let mut sizes: Vec<_> = cells.iter().map(|cell| cell.size).collect();
    sizes.sort_unstable();
    sizes.dedup();
    let mut text =
        "\nOur default by Embree's fastest way, geometric mean over the scenes:\n".to_owned();
    let mut head = format!("{:<8} {:<7}", "rays", "isa");
    for size in &sizes {
        let _ = write!(head, " {size:>6}²");
    }
    let _ = writeln!(text, "{head}     all");
    for kind in Kind::ALL {
        for isa in Isa::ALL {
            let lead = |size: Option<u32>| {
                let of = cells.iter().filter(|c| c.kind == kind && c.isa == isa);
                let of = of.filter(|c| size.is_none_or(|size| c.size == size));
                let leads: Vec<_> = of.filter_map(Cell::lead).collect();
                (!leads.is_empty()).then(|| geometric_mean(&leads))
            };
            let Some(all) = lead(None) else { continue };
            let _ = write!(text, "{:<8} {:<7}", kind.name(), isa);
            for &size in &sizes {
                let _ = write!(text, " {:>7.3}", lead(Some(size)).unwrap_or(f64::NAN));
            }
            let _ = writeln!(text, " {all:>7.3}");
        }
    }
    text
}
