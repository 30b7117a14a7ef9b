//! What must not be in the assembly of kernels.

use super::flow::{Flow, call, never_returns};
use super::targets;
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

/// All faults of a listing.
pub(crate) fn check(listing: &Listing, arch: Arch) -> Vec<Fault> {
    let mut faults = Vec::new();
    for function in &listing.functions {
        let name = path(&function.symbol);
        let level = targets::of_path(&name);
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
        for instruction in hot_calls(function, &name, listing, arch) {
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
        && instruction
            .words()
            .any(|word| ["xmm", "ymm", "zmm"].iter().any(|kind| word.starts_with(kind)))
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
) -> Vec<&'a Instruction> {
    let operation = name.contains("::ops::");
    let may_return = |instruction: &&Instruction| {
        call(instruction, arch).is_some_and(|callee| !callee.is_some_and(never_returns))
    };
    if !function.code.iter().any(|instruction| may_return(&instruction)) {
        return Vec::new();
    }
    let flow = Flow::of(function, arch, &listing.tabled);
    let code = function.code.iter().enumerate();
    code.filter(|(i, _)| operation || flow.in_loop(*i))
        .map(|(_, instruction)| instruction)
        .filter(may_return)
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const MUL: &str = "_RNvNtNtNtCs1_4core9core_arch3x863avx13__mm256_mul_ps";
    const XGETBV: &str = "_RNvNtNtNtCs1_4core9core_arch3x865xsave7__xgetbv";
    const PANIC: &str = "_RNvNtCs1_4core9panicking5panic";
    const OP: &str = "_RNvNtNtNtCs1_11simd4_probe3ops4avx25f32x83add";
    const KERNEL: &str = "_RNvNtNtCs1_11simd4_probe7kernels2x83dot";

    /// The faults of one function, each as its rule and instruction.
    fn faults(arch: Arch, symbol: &str, code: &str) -> Vec<(Rule, String)> {
        let text = format!("\t.type {symbol},@function\n{symbol}:\n{code}\n\t.size {symbol}, 1\n");
        let faults = check(&Listing::parse(&text), arch);
        faults.into_iter().map(|fault| (fault.rule, fault.instruction)).collect()
    }

    fn on_x86(symbol: &str, code: &str) -> Vec<(Rule, String)> {
        faults(Arch::X86, symbol, code)
    }

    #[test]
    fn the_paths_are_what_the_tests_below_take_them_for() {
        assert_eq!(path(MUL), "core::core_arch::x86::avx::_mm256_mul_ps");
        assert_eq!(path(XGETBV), "core::core_arch::x86::xsave::_xgetbv");
        assert_eq!(path(OP), "simd4_probe::ops::avx2::f32x8::add");
        assert_eq!(path(KERNEL), "simd4_probe::kernels::x8::dot");
    }

    #[test]
    fn an_intrinsic_is_a_fault_where_it_stands_and_where_it_is_used() {
        let found = on_x86(MUL, "vmulps ymm0, ymm0, ymm1\nret");
        assert_eq!(found, [(Rule::Intrinsic, "the function itself".to_owned())]);
        for (arch, code) in [
            (Arch::X86, format!("call qword ptr [rip + {MUL}@GOTPCREL]\nret")),
            (Arch::X86, format!("jmp {MUL}")),
            (Arch::X86, format!("lea rax, [rip + {MUL}]\nret")),
            (Arch::Arm, format!("bl {MUL}\nret")),
            (Arch::Wasm, format!("call {MUL}")),
        ] {
            let found = faults(arch, KERNEL, &code);
            let [(Rule::Intrinsic, instruction)] = found.as_slice() else { panic!("{found:?}") };
            assert!(instruction.contains("core::core_arch::x86::avx::_mm256_mul_ps"));
        }
    }

    #[test]
    fn detection_may_call_its_own() {
        assert_eq!(on_x86(XGETBV, "xgetbv\nret"), []);
        assert_eq!(on_x86(KERNEL, &format!("call qword ptr [rip + {XGETBV}@GOTPCREL]\nret")), []);
    }

    #[test]
    fn a_kernel_calls_nothing_in_its_loops() {
        let called = |code: &str| on_x86(KERNEL, code);
        let fault = vec![(Rule::Call, "call memcpy@PLT".to_owned())];
        assert_eq!(called(".LBB0_1:\ncall memcpy@PLT\ndec rax\njne .LBB0_1\nret"), fault);
        assert_eq!(called("call memcpy@PLT\n.LBB0_1:\ndec rax\njne .LBB0_1\nret"), []);
        let panics = format!(
            ".LBB0_1:\ncmp rax, 9\nja .LBB0_2\ndec rax\njne .LBB0_1\nret\n.LBB0_2:\ncall {PANIC}\n\
             jmp .LBB0_1"
        );
        assert_eq!(called(&panics), []);
    }

    #[test]
    fn an_operation_calls_nothing_at_all() {
        let code = "call qword ptr [rip + memcpy@GOTPCREL]\nret";
        assert_eq!(on_x86(OP, code).len(), 1);
        assert_eq!(on_x86(OP, &format!("cmp rsi, 7\nja .LBB0_1\ncall {PANIC}\n.LBB0_1:\nret")), []);
    }

    #[test]
    fn legacy_sse_is_a_fault_beside_vex_only() {
        let fault = |instruction: &str| vec![(Rule::Mixed, instruction.to_owned())];
        assert_eq!(on_x86(OP, "addps xmm0, xmm1\nret"), []);
        assert_eq!(on_x86(OP, "vaddps xmm0, xmm0, xmm1\npush rax\nret"), []);
        assert_eq!(
            on_x86(OP, "vaddps ymm0, ymm0, ymm1\naddps xmm0, xmm1\nret"),
            fault("addps xmm0, xmm1")
        );
        assert_eq!(
            on_x86(OP, "movd xmm0, edi\nvaddps zmm0, zmm0, zmm1\nret"),
            fault("movd xmm0, edi")
        );
        // `verr` is old and has nothing to do with vectors.
        assert_eq!(on_x86(OP, "verr ax\naddps xmm0, xmm1\nret"), []);
    }
}
