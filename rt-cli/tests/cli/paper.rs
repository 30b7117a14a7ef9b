//! `rt paper`.

use crate::support::Scratch;

#[test]
fn every_table_and_chart_of_a_paper_is_there() {
    let scratch = Scratch::with_room();
    let small = ["--triangles", "2000", "--quick", "--rounds", "1", "--charts", "."];
    let args = [&["paper", "wald-2001", "room.obj"], &small[..]].concat();
    let text = scratch.rt(&args).exits(0).text();
    for head in ["Table 1", "Table 2", "Table 3", "Mailboxes", "Figure 5"] {
        assert!(text.contains(head), "{head} in {text}");
    }
    for scene in ["terrain:800", "room.obj"] {
        let rows = text.lines().filter(|line| line.starts_with(scene)).count();
        assert!(rows > 0, "{scene} in {text}");
    }
    for structure in ["bvh binned-sah", "kd binned", "kd sweep", "kd median"] {
        assert!(text.contains(structure), "{structure} in {text}");
    }
    for chart in ["mailboxes.svg", "growth.svg"] {
        assert!(scratch.bytes(chart).starts_with(b"<svg"), "{chart}");
    }
}
