//! `cargo xtask asm`: reads the machine code of kernels. What rustc is believed to do for them, and
//! may stop doing, is seen here.
//!
//! `simd4/probe` has every operation as a function, at every level and width, and sample kernels.
//! It is compiled to assembly for each target that is there, and [`gates`] lists what must not be
//! found in it; the intrinsics among that not in the program `rt` either. The same assembly makes
//! the [`table`] of instructions that the documentation of simd4 shows.

mod binary;
mod build;
mod count;
mod flow;
mod gates;
mod levels;
mod table;
mod text;

use crate::report::Outcome;
use levels::TARGETS;
use table::Table;
use xshell::{Shell, cmd};

/// The most faults of one listing that are shown.
const SHOWN: usize = 20;

/// One thing checked.
#[derive(Debug)]
pub(crate) struct Check {
    pub(crate) name: String,
    pub(crate) outcome: Outcome,
    /// What is wrong or missing.
    pub(crate) reason: String,
}

impl Check {
    fn new(name: impl Into<String>, faults: Result<Vec<String>, String>) -> Check {
        let (outcome, reason) = match faults {
            Ok(faults) if faults.is_empty() => (Outcome::Passed, String::new()),
            Ok(faults) => {
                let more = faults.len().saturating_sub(SHOWN);
                let mut lines = faults[..faults.len() - more].to_vec();
                if more > 0 {
                    lines.push(format!("and {more} more"));
                }
                (Outcome::Failed, lines.join("\n"))
            }
            Err(error) => (Outcome::Failed, error),
        };
        Check { name: name.into(), outcome, reason }
    }
}

/// Checks everything; prints nothing. With `bless` the instruction table is written, not checked.
pub(crate) fn check(sh: &Shell, bless: bool) -> Vec<Check> {
    let mut checks = Vec::new();
    let mut table = Table::default();
    for target in &TARGETS {
        let name = format!("asm, {}", target.name);
        if let Err(reason) = build::available(sh, target.triple) {
            checks.push(Check { name, outcome: Outcome::Skipped, reason });
            continue;
        }
        let faults = build::listing(sh, target, "simd4-probe", "").map(|listing| {
            table.add(target, &listing);
            shown(gates::check(&listing, target.arch))
        });
        checks.push(Check::new(name, faults));
    }
    checks.push(Check::new("asm, rt", binary::intrinsics(sh)));
    checks.push(instructions(sh, table, bless));
    checks
}

/// One line a fault.
fn shown(faults: Vec<gates::Fault>) -> Vec<String> {
    faults.iter().map(ToString::to_string).collect()
}

/// Compares the table with the one in the documentation, or writes it there.
fn instructions(sh: &Shell, table: Table, bless: bool) -> Check {
    const FILE: &str = "simd4/INSTRUCTIONS.md";
    let name = "asm, instruction table";
    let skipped = |reason| Check { name: name.to_owned(), outcome: Outcome::Skipped, reason };
    let rustc = match cmd!(sh, "rustc --version").quiet().read() {
        Ok(version) => version.split(' ').nth(1).unwrap_or_default().to_owned(),
        Err(error) => return Check::new(name, Err(error.to_string())),
    };
    if bless {
        let missing: Vec<&str> = table.missing().collect();
        let written = match missing.as_slice() {
            [] => sh.write_file(FILE, table.to_markdown(&rustc)).map_err(|e| e.to_string()),
            _ => Err(format!("nothing written: there are no figures of {}", missing.join(", "))),
        };
        return Check::new(name, written.map(|()| Vec::new()));
    }
    let blessed = sh.read_file(FILE).map_err(|error| error.to_string());
    match blessed.map(|text| Table::parse(&text)) {
        Err(error) => Check::new(name, Err(error)),
        Ok(Err(error)) => Check::new(name, Err(format!("{FILE}: {error}"))),
        Ok(Ok((of, _))) if of != rustc => {
            skipped(format!("{FILE} is of rustc {of}, and this is {rustc}"))
        }
        Ok(Ok((_, blessed))) => {
            let mut differences = blessed.differences(&table);
            if !differences.is_empty() {
                differences.push(format!("{FILE} is out of date: cargo xtask asm --bless"));
            }
            Check::new(name, Ok(differences))
        }
    }
}

/// Runs the command: checks, prints, and says whether nothing failed.
pub(crate) fn asm(sh: &Shell, bless: bool) -> bool {
    let mut ok = true;
    for Check { name, outcome, reason } in check(sh, bless) {
        let (word, gap) = match outcome {
            Outcome::Passed => ("passed", ""),
            Outcome::Failed => ("FAILED", "\n"),
            Outcome::Skipped => ("skipped", " "),
        };
        println!("{name:24} {word}{gap}{reason}");
        ok &= outcome != Outcome::Failed;
    }
    ok
}

#[cfg(test)]
mod tests {
    use super::*;
    use gates::Rule;
    use levels::X86_64;

    /// The plant is what the gates are for: see `simd4/probe/src/planted.rs`.
    #[test]
    fn a_closure_that_has_fallen_out_of_its_level_is_caught() {
        let sh = crate::root().expect("there is a repository");
        if let Err(reason) = build::available(&sh, X86_64.triple) {
            panic!("{reason}");
        }
        let listing = build::listing(&sh, &X86_64, "simd4-probe", "planted").expect("it compiles");
        let faults = gates::check(&listing, X86_64.arch);
        let caught = |rule, function: &str, instruction: &str| {
            faults.iter().any(|fault| {
                fault.rule == rule
                    && fault.level == Some("avx2")
                    && fault.function.contains(function)
                    && fault.instruction.contains(instruction)
            })
        };
        // In the closure each intrinsic is a function, and the kernel's loop calls the closure.
        let closure = "planted::kernel::<simd4::arch::x86::avx2::Avx2>::{closure#0}";
        assert!(
            caught(Rule::Intrinsic, closure, "core::core_arch::x86::avx::_mm256_mul_ps"),
            "{faults:#?}"
        );
        assert!(caught(Rule::Call, "planted::fallen", closure), "{faults:#?}");
    }
}
