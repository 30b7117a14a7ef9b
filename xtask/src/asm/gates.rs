//! What must not be in the assembly of kernels.

use super::flow::{Flow, call, never_returns};
use super::levels;
use super::text::{Arch, Function, Instruction, Listing, path};
use std::fmt;

/// A rule.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rule {
    /// No intrinsic is a function of its own, save `_xgetbv`, which detection uses.
    ///
    /// The compiler inlines an intrinsic into every function that is compiled for it, so one that
    /// is left was called from code that has fallen out of its level.
    Intrinsic,
    /// Nothing is called in a loop, see [`Flow::in_loop`], and nothing by an operation, whose
    /// place is in loops. Calls that never return are no calls.
    Call,
    /// No function that has VEX or EVEX instructions has one of legacy SSE: changing from one
    /// encoding to the other may cost as much as a division.
    Mixed,
}

/// A rule broken.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Fault {
    pub(crate) rule: Rule,
    /// Where, as a path.
    pub(crate) function: String,
    /// The level that the function is of, if it says so.
    pub(crate) level: Option<&'static str>,
    /// By what.
    pub(crate) instruction: String,
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let what = match self.rule {
            Rule::Intrinsic => "an intrinsic is not inlined",
            Rule::Call => "a call where the code is hot",
            Rule::Mixed => "legacy SSE among VEX instructions",
        };
        let Fault { function, level, instruction, .. } = self;
        write!(f, "{what}: `{instruction}` in {function}, level {}", level.unwrap_or("unknown"))
    }
}

/// Which calls are faults.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Calls {
    /// Those in loops, and those of the operations of the probe.
    OfProbe,
    /// Those in the loops of functions that are compiled for a level.
    OfLevels,
}

/// Operations that copy as many elements as a slice has.
const MAY_COPY: [&str; 2] = ["load_prefix", "store_prefix"];

/// All faults of a listing.
pub(crate) fn check(listing: &Listing, arch: Arch, calls: Calls) -> Vec<Fault> {
    let mut faults = Vec::new();
    for function in &listing.functions {
        let name = path(&function.symbol);
        let level = levels::of_path(&name);
        let mut fault = |rule, instruction: &dyn fmt::Display| {
            let (function, instruction) = (name.clone(), instruction.to_string());
            faults.push(Fault { rule, function, level, instruction });
        };
        if is_intrinsic(&name) {
            fault(Rule::Intrinsic, &"the function itself");
        }
        for instruction in &function.code {
            if instruction.words().any(|word| word.len() > 8 && is_intrinsic(&path(word))) {
                fault(Rule::Intrinsic, instruction);
            }
        }
        if arch == Arch::X86 && function.code.iter().any(is_vex) {
            for instruction in function.code.iter().filter(|instruction| is_legacy(instruction)) {
                fault(Rule::Mixed, instruction);
            }
        }
        for instruction in hot_calls(function, &name, listing, arch, calls) {
            fault(Rule::Call, instruction);
        }
    }
    faults
}

/// Whether a path is an intrinsic's. `_xgetbv` is told apart here, so that it is so everywhere.
pub(crate) fn is_intrinsic(path: &str) -> bool {
    path.strip_prefix("core::core_arch::").is_some_and(|rest| !rest.ends_with("::_xgetbv"))
}

/// A vector instruction of the newer encodings.
fn is_vex(instruction: &Instruction) -> bool {
    instruction.mnemonic.starts_with('v')
        && instruction.words().any(|word| {
            ["xmm", "ymm", "zmm"].iter().any(|kind| word.starts_with(kind))
        })
}

/// A vector instruction of the older encoding.
fn is_legacy(instruction: &Instruction) -> bool {
    !instruction.mnemonic.starts_with('v')
        && instruction.words().any(|word| word.starts_with("xmm"))
}

/// The calls that a function should not make.
fn hot_calls<'a>(
    function: &'a Function,
    name: &str,
    listing: &Listing,
    arch: Arch,
    calls: Calls,
) -> Vec<&'a Instruction> {
    let operation = calls == Calls::OfProbe && name.contains("::ops::");
    let exempt = match calls {
        Calls::OfProbe => operation && MAY_COPY.iter().any(|op| name.ends_with(op)),
        Calls::OfLevels => !name.contains("simd4::"),
    };
    let may_return = |instruction: &&Instruction| {
        call(instruction, arch).is_some_and(|callee| !callee.is_some_and(never_returns))
    };
    if exempt || !function.code.iter().any(|instruction| may_return(&instruction)) {
        return Vec::new();
    }
    let flow = Flow::of(function, arch, &listing.tabled);
    let code = function.code.iter().enumerate();
    code.filter(|(i, _)| operation || flow.in_loop(*i))
        .map(|(_, instruction)| instruction)
        .filter(may_return)
        .collect()
}
