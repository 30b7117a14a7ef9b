//! Table 1: a ray-triangle test.

use rt_render::measure;
use serde_json::json;

use super::{Paper, four_lanes};
use crate::error::Error;

pub(super) fn run(paper: &mut Paper<'_>) -> Result<(), Error> {
    let level = four_lanes(paper.level);
    paper.show(&format!(
        "Table 1: ns a ray-triangle test at {level}; the paper: cycles, 1.25 ns each\n\
         {:<32}{:>7}{:>7}{:>12}{:>15}   {}",
        "", "least", "most", "speed-up", "from memory", "paper's cycles"
    ))?;
    let rows = measure::tests(level, paper.rounds(), paper.args.quick);
    let words = [
        ("Wald, scalar", "78 to 148"),
        ("Wald, lanes for its equations", "20 % faster"),
        ("Plücker, lanes for its edges", "77 to 123"),
        ("Wald, lanes for four rays", "22 to 41, 3.5 to 3.7 ×"),
    ];
    for (row, (name, figures)) in rows.iter().zip(words) {
        paper.show(&format!(
            "{name:<32}{:>7.2}{:>7.2}{:>7.1} to {:<3.1}{:>8.2}, {:>+4.0} %  {figures}",
            row.least,
            row.most,
            rows[0].least / row.least,
            rows[0].most / row.most,
            row.memory,
            (row.memory / row.least - 1.0) * 100.0,
        ))?;
        paper.rows.push(json!({
            "what": "test",
            "kernel": name,
            "level": level.name(),
            "ns_least": row.least,
            "ns_most": row.most,
            "ns_memory": row.memory,
            "paper": figures,
        }));
    }
    paper.show("The paper: over 60 % more where the triangle comes from memory.\n")
}
