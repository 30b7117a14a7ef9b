//! What was measured, as tables and as JSON.

use std::fmt::Write;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::builds::Build;
use crate::cells::{Cell, Row};
use crate::leaks::{Family, Leak};
use crate::peers::{Isa, Mode};
use crate::race::geometric_mean;
use crate::rays::Kind;

/// Everything.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(crate) struct Report {
    pub(crate) cells: Vec<Cell>,
    pub(crate) builds: Vec<Build>,
    pub(crate) leaks: Vec<Leak>,
}

/// The columns of all cells' tables.
pub(crate) fn head() -> String {
    format!(
        "{:<11} {:>4} {:<7} {:<6} {:<7} {:<36}{:>8}  {:>9} {:>8} {:>6} {:>6} {:>6} {:>6} {:>6}\n",
        "scene",
        "size",
        "rays",
        "isa",
        "peer",
        "way (* its fastest)",
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

/// The rows of a cell; if `brief` only our default and the fastest of each peer.
pub(crate) fn table(cell: &Cell, brief: bool) -> String {
    let mut table = String::new();
    for (i, row) in cell.rows.iter().enumerate() {
        let best = cell.fastest(|mode| mode.peer == row.mode.peer) == Some(i);
        if brief && !best && !row.mode.default {
            continue;
        }
        let Cell { scene, size, isa, .. } = cell;
        let (kind, peer, d) = (cell.kind.name(), &row.mode.peer, row.differences);
        let way = [&*row.mode.name, &*row.order].join(" ");
        let _ = writeln!(
            table,
            "{scene:<11} {size:>4} {kind:<7} {isa:<6} {peer:<7} {way:<36}{:>8.2}{} {:>9.3} {:>8.3} \
             {:>6.1} {:>6} {:>6} {:>6} {:>6}",
            row.mrays_per_s(),
            if best { '*' } else { ' ' },
            row.to_default,
            row.build_seconds,
            bytes_per_triangle(cell, row),
            d.missed,
            d.extra,
            d.other,
            d.moved,
        );
    }
    table
}

fn bytes_per_triangle(cell: &Cell, row: &Row) -> f64 {
    row.bytes as f64 / cell.triangles as f64
}

impl Report {
    /// What is told after the cells: builds, leaks, and last how we stand.
    pub(crate) fn closing(&self) -> String {
        [self.builds(), self.lost(), self.others(), self.summary()].concat()
    }

    fn builds(&self) -> String {
        let mut table = String::new();
        if !self.builds.is_empty() {
            let _ = writeln!(
                table,
                "\nBuilds: processor seconds on one thread, wall seconds on two\n\
                 {:<11} {:>9} {:<8} {:>7} {:>8} {:>6}",
                "scene", "triangles", "peer", "threads", "seconds", "× ours"
            );
        }
        for build in &self.builds {
            let Build { scene, triangles, peer, threads, seconds, to_ours } = build;
            let _ = writeln!(
                table,
                "{scene:<11} {triangles:>9} {peer:<8} {threads:>7} {seconds:>8.3} {to_ours:>6.2}"
            );
        }
        table
    }

    /// Leaks per million rays. Ways that lose the same are one row.
    fn lost(&self) -> String {
        let mut table = String::new();
        let mut places: Vec<&str> = Vec::new();
        for leak in &self.leaks {
            if !places.contains(&&*leak.place) {
                places.push(&leak.place);
            }
        }
        for place in places {
            let _ = writeln!(
                table,
                "\nLeaks per million rays aimed at a closed mesh of 81,920 triangles, {place}\n\
                 {:<8} {:>9} {:>9} {:>9}  ways",
                "peer", "edges", "vertices", "axes"
            );
            for (peer, lost, ways) in self.lost_at(place) {
                let [edge, vertex, axis] = lost;
                let ways = ways.join(", ");
                let _ = writeln!(table, "{peer:<8} {edge:>9} {vertex:>9} {axis:>9}  {ways}");
            }
        }
        table
    }

    /// Peer, leaks per million rays of each family, and the ways that lose so many.
    fn lost_at(&self, place: &str) -> Vec<(&str, [u64; 3], Vec<String>)> {
        let mut rows: Vec<(&str, [u64; 3], Vec<String>)> = Vec::new();
        let here = |leak: &&Leak| leak.place == place;
        for leak in self.leaks.iter().filter(here).filter(|leak| leak.family == Family::ALL[0]) {
            let lost = Family::ALL.map(|family| {
                let same = |other: &&Leak| {
                    (&other.peer, &other.mode, other.isa) == (&leak.peer, &leak.mode, leak.isa)
                        && other.family == family
                };
                let of = self.leaks.iter().filter(here).find(same);
                of.map_or(0, |l| (l.leaks as f64 * 1e6 / l.rays as f64).round() as u64)
            });
            let way = format!("{} {}", leak.isa, leak.mode);
            let row = rows.iter_mut().find(|(peer, other, _)| *peer == leak.peer && *other == lost);
            match row {
                Some((.., ways)) => ways.push(way),
                None => rows.push((&leak.peer, lost, vec![way])),
            }
        }
        rows
    }

    /// Geometric means over the scenes and sizes, our default by the fastest way of each peer that
    /// has no level of its own.
    fn others(&self) -> String {
        let mut peers: Vec<&str> = Vec::new();
        let native = || self.cells.iter().filter(|cell| cell.isa == Isa::Native);
        for row in native().flat_map(|cell| &cell.rows) {
            if !row.mode.is_ours() && !peers.contains(&&*row.mode.peer) {
                peers.push(&row.mode.peer);
            }
        }
        let mut table = String::new();
        if !peers.is_empty() {
            let _ = write!(
                table,
                "\nOur default by the fastest way of each, native, geometric mean\n{:<8}",
                "rays"
            );
            peers.iter().for_each(|peer| _ = write!(table, " {peer:>8}"));
            table.push('\n');
        }
        for kind in Kind::ALL {
            let leads = peers.iter().filter_map(|peer| {
                let over = |mode: &Mode| mode.peer == **peer;
                let cells = native().filter(|cell| cell.kind == kind);
                geometric_mean(&cells.filter_map(|cell| cell.lead(over)).collect::<Vec<_>>())
            });
            let leads: Vec<_> = leads.map(|lead| format!(" {lead:>8.2}")).collect();
            if !leads.is_empty() {
                let _ = writeln!(table, "{:<8}{}", kind.name(), leads.concat());
            }
        }
        table
    }

    /// Our default by Embree's fastest way: a row for each kind of ray and level, with the geometric
    /// mean over the scenes for each size and for all.
    fn summary(&self) -> String {
        let sizes = self.sizes();
        let mut table =
            "\nOur default by Embree's fastest way, geometric mean over the scenes\n".to_owned();
        let _ = write!(table, "{:<8} {:<7}", "rays", "isa");
        sizes.iter().for_each(|size| _ = write!(table, " {:>7}", format!("{size}²")));
        table.push_str("     all\n");
        for (kind, isa) in Kind::ALL.into_iter().flat_map(|kind| Isa::ALL.map(|isa| (kind, isa))) {
            let Some(all) = self.headline(kind, isa, None) else { continue };
            let _ = write!(table, "{:<8} {isa:<7}", kind.name());
            for &size in &sizes {
                let mean = self.headline(kind, isa, Some(size)).unwrap_or(f64::NAN);
                let _ = write!(table, " {mean:>7.3}");
            }
            let _ = writeln!(table, " {all:>7.3}");
        }
        table
    }

    fn sizes(&self) -> Vec<u32> {
        let mut sizes: Vec<_> = self.cells.iter().map(|cell| cell.size).collect();
        sizes.sort_unstable();
        sizes.dedup();
        sizes
    }

    /// The geometric mean over the scenes, for one size or all.
    pub(crate) fn headline(&self, kind: Kind, isa: Isa, size: Option<u32>) -> Option<f64> {
        let cells = self.cells.iter().filter(|cell| (cell.kind, cell.isa) == (kind, isa));
        let cells = cells.filter(|cell| size.is_none_or(|size| cell.size == size));
        geometric_mean(&cells.filter_map(|cell| cell.lead(Mode::is_embree)).collect::<Vec<_>>())
    }

    /// What scripts read.
    pub(crate) fn json(&self, spatial: bool) -> Value {
        let rows: Vec<_> = self
            .cells
            .iter()
            .flat_map(|cell| cell.rows.iter().map(|row| row_json(cell, row)))
            .collect();
        let kinds = Kind::ALL.into_iter().flat_map(|kind| Isa::ALL.map(|isa| (kind, isa)));
        let sizes: Vec<_> = self.sizes().into_iter().map(Some).chain([None]).collect();
        let headlines = kinds.flat_map(|key| sizes.iter().map(move |&size| (key, size)));
        let summary: Vec<_> = headlines
            .filter_map(|((kind, isa), size)| {
                let mean = self.headline(kind, isa, size)?;
                Some(json!({ "rays": kind, "isa": isa, "size": size, "to_embree": mean }))
            })
            .collect();
        json!({
            "spatial": spatial,
            "rows": rows,
            "builds": self.builds,
            "leaks": self.leaks,
            "summary": summary,
        })
    }
}

fn row_json(cell: &Cell, row: &Row) -> Value {
    json!({
        "scene": cell.scene,
        "triangles": cell.triangles,
        "rays": cell.kind,
        "size": cell.size,
        "peer": row.mode.peer,
        "mode": row.mode.name,
        "default": row.mode.default,
        "order": row.order,
        "isa": cell.isa,
        "traced": row.rays,
        "mrays_per_s": row.mrays_per_s(),
        "to_default": row.to_default,
        "build_s": row.build_seconds,
        "bytes_per_triangle": bytes_per_triangle(cell, row),
        "differences": row.differences,
    })
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::check::Differences;

    fn row(peer: &str, name: &str, seconds: f64) -> Row {
        Row {
            mode: Mode { peer: peer.to_owned(), name: name.to_owned(), default: name == "default" },
            order: String::new(),
            rays: 1_000_000,
            seconds,
            to_default: 0.1 / seconds,
            differences: Differences::default(),
            build_seconds: 0.5,
            bytes: 800,
        }
    }

    /// Our default takes 0.1 s in each cell; Embree's fastest way 0.2 and 0.05 s.
    pub(crate) fn report() -> Report {
        let cell = |scene: &str, best, isa| Cell {
            scene: scene.to_owned(),
            triangles: 10,
            size: 512,
            kind: Kind::Primary,
            isa,
            rows: vec![
                row("rt", "default", 0.1),
                row("rt", "bvh8", 0.09),
                row("embree4", "1", 0.4),
                row("embree4", "8 coherent", best),
                row("parry3d", "1", 0.8),
            ],
        };
        let leak = |mode: &str, family, leaks| Leak {
            peer: "embree4".to_owned(),
            mode: mode.to_owned(),
            isa: Isa::Avx2,
            place: "here".to_owned(),
            family,
            rays: 500,
            leaks,
        };
        let leaks = ["1", "4", "8"].map(|mode| {
            Family::ALL.map(|family| leak(mode, family, if mode == "8" { 1 } else { 2 }))
        });
        Report {
            cells: vec![cell("a", 0.2, Isa::Native), cell("b", 0.05, Isa::Native)],
            builds: Vec::new(),
            leaks: leaks.into_iter().flatten().collect(),
        }
    }

    #[test]
    fn the_headline_is_our_default_by_embrees_fastest() {
        let mean = report().headline(Kind::Primary, Isa::Native, Some(512)).expect("two cells");
        assert!((mean - 1.0).abs() < 1e-12, "twice and half as fast: {mean}");
        assert_eq!(report().headline(Kind::Shadow, Isa::Native, None), None);
    }

    #[test]
    fn the_last_table_is_the_summary() {
        let text = report().closing();
        let last = text.lines().last().expect("a table");
        assert_eq!(
            last.split_whitespace().collect::<Vec<_>>(),
            ["primary", "native", "1.000", "1.000"]
        );
        let others = text.lines().find(|line| line.starts_with("primary")).expect("a table");
        assert_eq!(others.split_whitespace().last(), Some("8.00"), "parry3d: {text}");
    }

    #[test]
    fn a_brief_table_has_our_default_and_the_fastest_of_each() {
        let cell = &report().cells[0];
        assert_eq!(table(cell, false).lines().count(), 5);
        let brief = table(cell, true);
        assert_eq!(brief.lines().count(), 4, "{brief}");
        assert!(brief.contains("10.00 ") && brief.contains("5.00*"), "{brief}");
    }

    #[test]
    fn ways_that_lose_the_same_are_one_row() {
        let report = report();
        let rows = report.lost_at("here");
        assert_eq!(rows.len(), 2);
        assert_eq!((rows[0].1, rows[0].2.len()), ([4000; 3], 2));
    }

    #[test]
    fn scripts_find_their_keys() {
        let json = report().json(false);
        for key in ["scene", "rays", "size", "peer", "mode", "isa", "mrays_per_s", "build_s"] {
            assert!(!json["rows"][0][key].is_null(), "{key}");
        }
        assert_eq!(json["rows"][0]["bytes_per_triangle"], 80.0);
        assert_eq!(json["rows"][0]["rays"], "primary");
        assert_eq!(json["leaks"][1]["family"], "vertex");
    }

    #[test]
    fn a_report_comes_back_from_the_child() {
        let text = serde_json::to_string(&report()).expect("JSON");
        let back: Report = serde_json::from_str(&text).expect("a report");
        assert_eq!(back.json(false), report().json(false));
    }
}
