//! The speeds as a picture: for each kind of ray and level, everyone beside Embree's fastest way.

use std::fmt::Write;

use crate::cells::Cell;
use crate::peers::{Isa, Mode};
use crate::race::geometric_mean;
use crate::rays::Kind;
use crate::report::Report;

/// Who is shown beside Embree, and in which colour: Okabe and Ito's (2008), which the colour-blind
/// tell apart too.
const PEERS: [(&str, &str); 4] =
    [("rt", "#0072b2"), ("obvhs", "#e69f00"), ("bvh", "#999999"), ("parry3d", "#cc79a7")];

const EMBREE: &str = "#d55e00";

/// The height of a panel's bars for a ratio of one, and for the greatest that has room.
const ONE: f64 = 48.0;
const ROOM: f64 = 3.0;

/// The width of a group of bars, and of the gap after it.
const GROUP: f64 = 30.0;
const GAP: f64 = 14.0;

/// Above a panel, for its title, and below, for the scenes' names.
const ABOVE: f64 = 26.0;
const BELOW: f64 = 62.0;
const LEFT: f64 = 34.0;
const HEAD: f64 = 56.0;

/// A scene and the ratios to Embree of all who are there.
type Group<'a> = (&'a str, Vec<Option<f64>>);

/// Draws a panel for each kind of ray, in rows, and level, in columns. A bar is how many times as fast
/// a peer is as Embree's fastest way, ours by its default: the geometric mean over the sizes of the
/// picture, and on the right that over the scenes.
pub(crate) fn svg(report: &Report) -> String {
    let there = |isa: &Isa| report.cells.iter().any(|cell| cell.isa == *isa);
    let levels: Vec<_> = Isa::ALL.into_iter().filter(there).collect();
    let kinds: Vec<_> =
        Kind::ALL.into_iter().filter(|kind| report.cells.iter().any(|c| c.kind == *kind)).collect();
    let scenes = scenes(&report.cells);
    let width = LEFT + (scenes.len() + 1) as f64 * (GROUP + GAP) + GAP;
    let height = ABOVE + ONE * ROOM + BELOW;
    let (all_wide, all_high) =
        ((width * levels.len() as f64 + GAP).max(560.0), HEAD + height * kinds.len() as f64);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{all_wide}\" height=\"{all_high}\" \
         font-family=\"sans-serif\" font-size=\"12\" fill=\"#222222\">\n\
         <rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n\
         <text x=\"{GAP}\" y=\"22\" font-size=\"15\" font-weight=\"bold\">Rays a second, by \
         Embree's fastest way on the same instructions</text>\n"
    );
    legend(&mut svg, &report.cells);
    for (row, &kind) in kinds.iter().enumerate() {
        for (column, &isa) in levels.iter().enumerate() {
            let cells: Vec<_> =
                report.cells.iter().filter(|c| (c.kind, c.isa) == (kind, isa)).collect();
            let (x, y) = (width * column as f64, HEAD + height * row as f64);
            let _ = writeln!(svg, "<g transform=\"translate({x} {y})\">");
            panel(&mut svg, &format!("{}, {isa}", kind.name()), &groups(&cells, &scenes), width);
            svg.push_str("</g>\n");
        }
    }
    svg.push_str("</svg>\n");
    svg
}

/// The names of all scenes, in the order in which they were measured.
fn scenes(cells: &[Cell]) -> Vec<&str> {
    let mut scenes: Vec<&str> = Vec::new();
    for cell in cells {
        if !scenes.contains(&&*cell.scene) {
            scenes.push(&cell.scene);
        }
    }
    scenes
}

/// The bars of a panel.
fn groups<'a>(cells: &[&Cell], scenes: &[&'a str]) -> Vec<Group<'a>> {
    let ratio = |cell: &&Cell, peer: &str| {
        let shown = |mode: &Mode| mode.peer == peer && (mode.default || !mode.is_ours());
        // How far our default leads over Embree, and over the peer.
        Some(cell.lead(Mode::is_embree)? / cell.lead(shown)?)
    };
    let of_scene = |scene: Option<&str>| {
        let here = |cell: &&&Cell| scene.is_none_or(|scene| cell.scene == scene);
        let mean = |(peer, _): (&str, _)| {
            let ratios = cells.iter().filter(here).filter_map(|cell| ratio(cell, peer));
            geometric_mean(&ratios.collect::<Vec<_>>())
        };
        PEERS.map(mean).to_vec()
    };
    let one_by_one = scenes.iter().map(|&scene| (scene, of_scene(Some(scene))));
    one_by_one.chain([("all", of_scene(None))]).collect()
}

/// Which colour is whose.
fn legend(svg: &mut String, cells: &[Cell]) {
    let mut x = GAP;
    for (peer, color) in PEERS {
        let rows = || cells.iter().flat_map(|cell| &cell.rows);
        if !rows().any(|row| row.mode.peer == peer) {
            continue;
        }
        let name = if peer == "rt" { "this repository, by default" } else { peer };
        let _ = writeln!(
            svg,
            "<rect x=\"{x}\" y=\"33\" width=\"11\" height=\"11\" fill=\"{color}\"/>\
             <text x=\"{}\" y=\"43\">{name}</text>",
            x + 16.0
        );
        x += 36.0 + 6.3 * name.len() as f64;
    }
    let _ = writeln!(
        svg,
        "<path d=\"M{x} 39H{}\" stroke=\"{EMBREE}\" stroke-width=\"2\"/>\
         <text x=\"{}\" y=\"43\">Embree, its fastest way</text>",
        x + 16.0,
        x + 21.0
    );
}

/// One kind of ray at one level.
fn panel(svg: &mut String, title: &str, groups: &[Group], width: f64) {
    let base = ABOVE + ONE * ROOM;
    let right = width - GAP;
    let _ = writeln!(svg, "<text x=\"{LEFT}\" y=\"16\" font-weight=\"bold\">{title}</text>");
    for step in 0..=ROOM as u32 {
        let y = base - ONE * f64::from(step);
        // Embree is at one.
        let color = if step == 1 { EMBREE } else { "#dddddd" };
        let _ = writeln!(
            svg,
            "<path d=\"M{LEFT} {y}H{right}\" stroke=\"{color}\"/>\
             <text x=\"{}\" y=\"{}\" text-anchor=\"end\" fill=\"#666666\">{step}</text>",
            LEFT - 6.0,
            y + 4.0
        );
    }
    for (i, (name, ratios)) in groups.iter().enumerate() {
        let x = LEFT + GAP + i as f64 * (GROUP + GAP);
        let bars = ratios.iter().zip(PEERS).filter_map(|(ratio, peer)| Some(((*ratio)?, peer)));
        let (bars, name) = (bars.collect::<Vec<_>>(), escaped(name));
        let each = GROUP / bars.len().max(1) as f64;
        for (k, &(ratio, (peer, color))) in bars.iter().enumerate() {
            let x = x + k as f64 * each;
            let high = ONE * ratio.min(ROOM);
            let _ = writeln!(
                svg,
                "<rect x=\"{x:.1}\" y=\"{:.1}\" width=\"{:.1}\" height=\"{high:.1}\" \
                 fill=\"{color}\"><title>{peer}, {name}: {ratio:.2}</title></rect>",
                base - high,
                each - 1.0
            );
            // A bar may be cut: its number tells. What keeps it apart from lines is drawn before it, for
            // whoever knows no other order.
            for halo in [" stroke=\"white\" stroke-width=\"3\"", ""] {
                if peer == "rt" {
                    let _ = writeln!(
                        svg,
                        "<text x=\"{:.1}\" y=\"{:.1}\" font-size=\"10\" \
                         text-anchor=\"middle\"{halo}>{ratio:.2}</text>",
                        x + each / 2.0,
                        base - high - 3.0
                    );
                }
            }
        }
        let (x, y) = (x + GROUP / 2.0, base + 14.0);
        let weight = if i + 1 == groups.len() { "bold" } else { "normal" };
        let _ = writeln!(
            svg,
            "<text x=\"{x}\" y=\"{y}\" text-anchor=\"end\" font-weight=\"{weight}\" \
             transform=\"rotate(-40 {x} {y})\">{name}</text>"
        );
    }
}

/// A scene's name may be any file's.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::tests::report;

    #[test]
    fn bars_are_ratios_to_embrees_fastest() {
        let report = report();
        let cells: Vec<_> = report.cells.iter().collect();
        let groups = groups(&cells, &scenes(&report.cells));
        let ours: Vec<_> = groups.iter().map(|(name, ratios)| (*name, ratios[0])).collect();
        let close = |ratio: Option<f64>, to: f64| (ratio.expect("a bar") - to).abs() < 1e-9;
        assert!(
            close(ours[0].1, 2.0) && close(ours[1].1, 0.5) && close(ours[2].1, 1.0),
            "{ours:?}"
        );
        assert!(close(groups[0].1[3], 0.25), "parry3d takes 0.8 s where Embree takes 0.2 s");
        assert_eq!(groups[0].1[1], None, "obvhs is not there");
    }

    #[test]
    fn names_cannot_break_out() {
        let mut report = report();
        report.cells[0].scene = "<a&b>".to_owned();
        let svg = svg(&report);
        assert!(svg.contains("&lt;a&amp;b>") && !svg.contains("<a&b"), "{svg}");
    }
}
