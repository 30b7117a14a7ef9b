//! The instruction table of the documentation: what each operation is made of at each level.

use super::count::Count;
use super::targets::{Level, TARGETS, Target};
use super::text::{Listing, path};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fmt::Write as _;

/// The sections: the types, by their names in the probe without the number of lanes.
const SECTIONS: [&str; 4] = ["f32", "i32", "u32", "mask32"];

/// What the file says before the version of rustc.
const HEAD: &str = "\
What each operation is compiled to at each level.

Up to four instructions are named; of more there is the number.

* Counted is what the operation takes at the width of the level's registers; where only other
  widths have it, at the nearest of them. Operands are in registers, and the result is left in one.
* Not counted are copies between registers, constants (a loop keeps them in registers) and the
  return. Loads and stores are counted of the operations that are about memory; of a check the
  comparison and the jump, but not the panic.
* `+` marks a number of which not all run, or some several times: there are branches or loops.
* `0` is a constant, or only another name for the same bits.
* The masks of `avx512` are in general registers here, as functions pass them. Where a comparison
  has just made them, `and` is `kandw`, and `bitmask` a `kmovw`.

";

/// What it says last.
const FOOT: &str = "
<!-- Made by `cargo xtask asm --bless` and checked by `cargo xtask asm`. -->
";

/// What stands before the version.
const VERSION: &str = "As compiled by rustc ";

/// A cell's place: section, operation, level.
type Place = (String, String, String);

/// What stands in the cells.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct Table {
    cells: BTreeMap<Place, String>,
}

impl Table {
    /// Adds the levels of a target.
    pub(crate) fn add(&mut self, target: &Target, listing: &Listing) {
        let named = listing.named().into_iter();
        let named: HashMap<String, _> =
            named.map(|(name, function)| (path(name), function)).collect();
        for level in target.levels {
            let module = format!("simd4_probe::ops::{}::", level.module);
            for name in named.keys().filter_map(|name| name.strip_prefix(&module)) {
                let Some((section, op)) = section_and_op(name) else { continue };
                let function = widths(level)
                    .iter()
                    .find_map(|lanes| named.get(&format!("{module}{section}x{lanes}::{op}")));
                if let Some(function) = function {
                    let count = Count::of(function, target.arch, listing, about_memory(op));
                    let place = (section.to_owned(), op.to_owned(), level.name.to_owned());
                    self.cells.insert(place, count.to_string());
                }
            }
        }
    }

    /// The levels without figures.
    pub(crate) fn missing(&self) -> impl Iterator<Item = &'static str> {
        levels().filter(|level| self.cells.keys().all(|(.., has)| has != level))
    }

    /// The file of the documentation.
    pub(crate) fn to_markdown(&self, rustc: &str) -> String {
        let mut text = format!("{HEAD}{VERSION}{rustc}.\n");
        for section in SECTIONS {
            let ops = self.cells.keys().filter(|(of, ..)| of == section).map(|(_, op, _)| op);
            let _ = write!(text, "\n# {section}\n\n| |");
            levels().for_each(|level| text.extend([" ", level, " |"]));
            text.push_str("\n|---|");
            levels().for_each(|_| text.push_str("---|"));
            for op in ops.collect::<BTreeSet<_>>() {
                let _ = write!(text, "\n| {op} |");
                for level in levels() {
                    let place = (section.to_owned(), op.clone(), level.to_owned());
                    let cell = self.cells.get(&place).map_or("", String::as_str);
                    text.extend([" ", cell, " |"]);
                }
            }
            text.push('\n');
        }
        text.push_str(FOOT);
        text
    }

    /// Reads the file: the version of rustc that the table is of, and the table.
    pub(crate) fn parse(text: &str) -> Result<(String, Table), String> {
        let mut table = Table::default();
        let version = text.lines().find_map(|line| line.strip_prefix(VERSION));
        let version = version.ok_or_else(|| format!("no line says {VERSION:?}"))?;
        let (mut section, mut header) = ("", Vec::new());
        for line in text.lines() {
            if let Some(name) = line.strip_prefix("# ") {
                (section, header) = (name, Vec::new());
            }
            let Some(row) = line.strip_prefix('|').and_then(|row| row.strip_suffix('|')) else {
                continue;
            };
            let row: Vec<&str> = row.split('|').map(str::trim).collect();
            if header.is_empty() {
                header = row;
            } else if row.len() != header.len() {
                return Err(format!(
                    "this line has {} cells, not {}: {line}",
                    row.len(),
                    header.len()
                ));
            } else if !row[0].starts_with('-') {
                let cells = header.iter().zip(&row).skip(1).filter(|(_, cell)| !cell.is_empty());
                table.cells.extend(cells.map(|(level, cell)| {
                    let place = (section.to_owned(), row[0].to_owned(), (*level).to_owned());
                    (place, (*cell).to_owned())
                }));
            }
        }
        Ok((version.trim_end_matches('.').to_owned(), table))
    }

    /// Where this table, of the documentation, is not what is compiled now. Levels that there are
    /// no figures of now are left out.
    pub(crate) fn differences(&self, now: &Table) -> Vec<String> {
        let missing: Vec<&str> = now.missing().collect();
        let places: BTreeSet<&Place> = self.cells.keys().chain(now.cells.keys()).collect();
        let differ = places.into_iter().filter(|place| {
            !missing.contains(&place.2.as_str()) && self.cells.get(place) != now.cells.get(place)
        });
        let shown =
            |table: &Table, place| table.cells.get(place).map_or("nothing", |c| c).to_owned();
        differ
            .map(|place| {
                let (section, op, level) = place;
                let (was, is) = (shown(self, place), shown(now, place));
                format!("{section} {op} at {level}: the table says {was}, compiled is {is}")
            })
            .collect()
    }
}

/// The names of all levels, in the columns' order.
fn levels() -> impl Iterator<Item = &'static str> {
    TARGETS.iter().flat_map(|target| target.levels).map(|level| level.name)
}

/// Splits `f32x4::floor`. `a += b` is what `a + b` is.
fn section_and_op(name: &str) -> Option<(&str, &str)> {
    let (of, op) = name.split_once("::")?;
    let (section, _) = of.rsplit_once('x')?;
    let shown = SECTIONS.contains(&section) && !op.contains("::") && !op.ends_with("_assign");
    shown.then_some((section, op))
}

/// All widths, the level's own first.
fn widths(level: &Level) -> [usize; 3] {
    match level.lanes {
        8 => [8, 4, 16],
        16 => [16, 8, 4],
        _ => [4, 8, 16],
    }
}

/// Whether loads and stores are an operation's own.
fn about_memory(op: &str) -> bool {
    ["load", "store", "gather", "compress", "from_array", "to_array"]
        .iter()
        .any(|start| op.starts_with(start))
}

#[cfg(test)]
mod tests {
    use super::super::targets::X86_64;
    use super::*;

    fn listing() -> Listing {
        Listing::parse(
            "\t.type\t_RNvNtNtNtCs1_11simd4_probe3ops4sse25f32x43add,@function\n\
             _RNvNtNtNtCs1_11simd4_probe3ops4sse25f32x43add:\n\taddps xmm0, xmm1\n\tret\n\
             \t.type\t_RNvNtNtNtCs1_11simd4_probe3ops4sse25f32x83add,@function\n\
             _RNvNtNtNtCs1_11simd4_probe3ops4sse25f32x83add:\n\taddps xmm0, xmm2\n\
             \taddps xmm1, xmm3\n\tret\n\
             \t.type\t_RNvNtNtNtCs1_11simd4_probe3ops4avx25i32x46concat,@function\n\
             _RNvNtNtNtCs1_11simd4_probe3ops4avx25i32x46concat:\n\tret\n",
        )
    }

    fn table() -> Table {
        let mut table = Table::default();
        table.add(&X86_64, &listing());
        table
    }

    #[test]
    fn a_cell_is_of_the_levels_own_width_or_the_nearest() {
        let table = table();
        let cell = |section: &str, op: &str, level: &str| {
            let place = (section.to_owned(), op.to_owned(), level.to_owned());
            table.cells.get(&place).map(String::as_str)
        };
        assert_eq!(cell("f32", "add", "sse2"), Some("`addps`"));
        assert_eq!(cell("i32", "concat", "avx2"), Some("0"));
        assert_eq!(cell("f32", "add", "avx2"), None);
        assert_eq!(table.cells.len(), 2);
    }

    #[test]
    fn what_is_written_is_read_again() {
        let text = table().to_markdown("1.95.0");
        assert_eq!(Table::parse(&text), Ok(("1.95.0".to_owned(), table())));
    }

    #[test]
    fn differences_are_named_but_not_of_levels_that_were_not_compiled() {
        let blessed = table().to_markdown("1.95.0").replace("addps", "subps");
        let (_, mut blessed) = Table::parse(&blessed).expect("it is well formed");
        let place = |level: &str| ("f32".to_owned(), "add".to_owned(), level.to_owned());
        blessed.cells.insert(place("neon"), "`fadd`".to_owned());
        blessed.cells.insert(place("avx2"), "`vaddps`".to_owned());
        assert_eq!(
            blessed.differences(&table()),
            [
                "f32 add at avx2: the table says `vaddps`, compiled is nothing",
                "f32 add at sse2: the table says `subps`, compiled is `addps`",
            ]
        );
        assert!(table().differences(&table()).is_empty());
    }

    #[test]
    fn a_file_that_is_no_table_is_refused() {
        for text in [
            "",
            "| | sse2 |\n",
            "As compiled by rustc 1.95.0.\n# f32\n| | sse2 |\n|---|---|\n| add |\n",
        ] {
            assert!(Table::parse(text).is_err(), "{text:?}");
        }
    }
}
