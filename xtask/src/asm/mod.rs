//! `cargo xtask asm`: reads the machine code of kernels. What rustc is believed to do for them, and
//! may stop doing, is seen here.
//!
//! `simd4/probe` has every operation as a function, at every level and width, and sample kernels.
//! It is compiled to assembly for each target that is there, and [`gates`] lists what must not be
//! found in it; the intrinsics among that not in the program `rt` either. The same assembly makes
//! the [`table`] of instructions that the documentation of simd4 shows.

pub(crate) mod binary;
mod build;
mod count;
mod flow;
mod gates;
mod table;
mod targets;
mod text;

use crate::report::{Done, Report};
use crate::setup;
use std::thread;
use table::Table;
use targets::{TARGETS, Target};
use text::Listing;
use xshell::{Shell, cmd};

/// The file of the documentation that has the table.
const FILE: &str = "simd4/INSTRUCTIONS.md";

/// What of a list of faults is said: more of the same teaches nobody anything.
const SHOWN: usize = 20;

/// Runs the command: true if nothing failed.
pub(crate) fn asm(sh: &Shell, bless: bool) -> bool {
    let mut report = Report::default();
    operations(sh, &mut report, bless);
    shipped(sh, &mut report);
    println!("{report}");
    report.ok(false)
}

/// Checks the operations, or with `bless` writes their table and checks the rest.
pub(crate) fn operations(sh: &Shell, report: &mut Report, bless: bool) {
    let mut table = Table::default();
    thread::scope(|scope| {
        // Each is one unit, and so takes one core.
        let listings = TARGETS.each_ref().map(|target| {
            let there = setup::standard_library(sh, target.triple);
            (target, there.map(|()| scope.spawn(|| build::listing(target, ""))))
        });
        for (target, listing) in listings {
            report.step("asm", target.name, || match listing {
                Err(missing) => Done::skipped(missing),
                Ok(listing) => {
                    let listing = listing.join().expect("it does not panic");
                    listing.and_then(|listing| probe(target, &listing, &mut table)).into()
                }
            });
        }
    });
    report.step("asm", "table", || match bless {
        true => write(sh, &table).into(),
        false => compare(sh, &table),
    });
}

/// Checks the program `rt` as it is shipped.
pub(crate) fn shipped(sh: &Shell, report: &mut Report) {
    report.step("asm", "rt", || match binary::shipped(sh) {
        Ok(program) => binary::check(sh, &program),
        Err(error) => Err(error).into(),
    });
}

/// Holds a target's code to the gates and adds its levels to the table.
fn probe(target: &Target, listing: &Listing, table: &mut Table) -> Result<(), String> {
    table.add(target, listing);
    let mut levels = target.levels.iter().map(|level| level.name);
    if let Some(level) = levels.find(|level| table.missing().any(|missing| missing == *level)) {
        return Err(format!("the probe has no operations of {level}"));
    }
    none(gates::check(listing, target.arch).iter().map(ToString::to_string).collect())
}

/// Fails with the faults, if there are any.
fn none(faults: Vec<String>) -> Result<(), String> {
    let more = faults.len().saturating_sub(SHOWN);
    let mut lines = faults[..faults.len() - more].to_vec();
    lines.extend((more > 0).then(|| format!("and {more} more")));
    if faults.is_empty() { Ok(()) } else { Err(lines.join("\n      ")) }
}

/// The version of rustc.
fn rustc(sh: &Shell) -> Result<String, String> {
    let version = cmd!(sh, "rustc --version").quiet().read().map_err(|error| error.to_string())?;
    Ok(version.split(' ').nth(1).unwrap_or_default().to_owned())
}

/// Writes the table to the documentation.
fn write(sh: &Shell, table: &Table) -> Result<(), String> {
    let missing: Vec<&str> = table.missing().collect();
    if !missing.is_empty() {
        return Err(format!("nothing is written without figures of {}", missing.join(", ")));
    }
    sh.write_file(FILE, table.to_markdown(&rustc(sh)?)).map_err(|error| error.to_string())
}

/// Compares the table with the one of the documentation.
fn compare(sh: &Shell, table: &Table) -> Done {
    let read = || {
        let text = sh.read_file(FILE).map_err(|error| error.to_string())?;
        let (of, documented) = Table::parse(&text).map_err(|error| format!("{FILE}: {error}"))?;
        Ok((rustc(sh)?, of, documented))
    };
    let (rustc, of, documented) = match read() {
        Ok(read) => read,
        Err(error) => return Err(error).into(),
    };
    // Another compiler may well do otherwise, and no worse.
    if rustc != of {
        return Done::left(format!("{FILE} is of rustc {of}, and this is {rustc}"));
    }
    let mut differences = documented.differences(table);
    if !differences.is_empty() {
        differences.insert(0, format!("{FILE} is out of date: cargo xtask asm --bless"));
    }
    none(differences).into()
}

#[cfg(test)]
mod tests {
    use super::*;
    use gates::Rule;
    use proc_macro2::{TokenStream, TokenTree};
    use std::collections::HashSet;
    use targets::X86_64;

    /// The plant is what the gates are for: see `simd4/probe/src/planted.rs`.
    #[test]
    fn a_closure_that_has_fallen_out_of_its_level_is_caught() {
        let sh = crate::root().expect("there is a repository");
        setup::standard_library(&sh, X86_64.triple).expect("there is the target");
        let listing = build::listing(&X86_64, "planted").expect("it compiles");
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

    /// What a file says, as tokens.
    fn tokens(sh: &Shell, file: &str) -> TokenStream {
        sh.read_file(file).expect("it is there").parse().expect("it is Rust")
    }

    /// The names behind `fn`, but for those that the documentation hides.
    fn functions(tokens: TokenStream) -> Vec<String> {
        let tokens: Vec<TokenTree> = tokens.into_iter().collect();
        let mut hidden = false;
        let mut names = Vec::new();
        for pair in tokens.windows(2) {
            match pair {
                [TokenTree::Punct(_), TokenTree::Group(attribute)] => {
                    hidden |= attribute.stream().to_string().replace(' ', "") == "doc(hidden)";
                }
                [TokenTree::Ident(word), TokenTree::Ident(name)] if word == "fn" => {
                    names.extend((!std::mem::take(&mut hidden)).then(|| name.to_string()));
                }
                _ => {}
            }
        }
        names
    }

    /// All words, however deep.
    fn words(tokens: TokenStream, found: &mut HashSet<String>) {
        for token in tokens {
            match token {
                TokenTree::Group(group) => words(group.stream(), found),
                TokenTree::Ident(word) => drop(found.insert(word.to_string())),
                TokenTree::Punct(_) | TokenTree::Literal(_) => {}
            }
        }
    }

    #[test]
    fn every_operation_of_the_traits_is_probed() {
        let sh = crate::root().expect("there is a repository");
        let mut probed = HashSet::new();
        words(tokens(&sh, "simd4/probe/src/ops.rs"), &mut probed);
        // A value's token is no operation.
        probed.insert("token".to_owned());
        let mut operations = 0;
        for file in ["mod", "f32", "int", "mask"] {
            let mut is_trait = false;
            for token in tokens(&sh, &format!("simd4/src/types/{file}.rs")) {
                match token {
                    TokenTree::Ident(word) if word == "trait" => is_trait = true,
                    TokenTree::Group(body) if is_trait && body.to_string().starts_with('{') => {
                        is_trait = false;
                        for name in functions(body.stream()) {
                            assert!(probed.contains(&name), "{name} has no line in the probe");
                            operations += 1;
                        }
                    }
                    _ => {}
                }
            }
        }
        assert!(operations > 80, "only {operations} operations were found");
    }
}
