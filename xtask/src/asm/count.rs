//! What of a function's instructions is its operation.

use super::flow::{Flow, call};
use super::text::{Arch, Function, Instruction, Listing};
use std::collections::HashSet;
use std::fmt;

/// As many instructions are named; of more there is only the number.
const NAMED: usize = 4;

/// The instructions of an operation.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Count {
    /// Their names.
    mnemonics: Vec<String>,
    /// Whether all of them run, once, whatever the operands.
    straight: bool,
    /// Whether one of them calls.
    calls: bool,
}

impl Count {
    /// Reads the function of an operation. Loads and stores count only of operations that are
    /// `about_memory`.
    pub(crate) fn of(
        function: &Function,
        arch: Arch,
        listing: &Listing,
        about_memory: bool,
    ) -> Count {
        let flow = Flow::of(function, arch, &listing.tabled);
        let returning = flow.returning();
        let immediates = immediates(function);
        let kind = |instruction| match arch {
            Arch::X86 => x86(instruction),
            Arch::Arm => arm(instruction, &immediates),
            Arch::Wasm => wasm(instruction),
        };
        let calls = |(i, code): (usize, &Instruction)| returning[i] && call(code, arch).is_some();
        let code = function.code.iter().enumerate().filter(|(i, _)| returning[*i]);
        let counted = code.filter(|(_, instruction)| match kind(instruction) {
            Kind::Work => true,
            Kind::Memory => about_memory,
            Kind::Free => false,
        });
        Count {
            mnemonics: counted.map(|(_, instruction)| instruction.mnemonic.clone()).collect(),
            straight: flow.is_straight(&returning),
            calls: function.code.iter().enumerate().any(calls),
        }
    }
}

impl fmt::Display for Count {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.mnemonics.len() {
            n @ 1..=NAMED if self.straight => {
                write!(f, "`{}`", self.mnemonics[..n].join(" "))
            }
            n => {
                let branches = if self.straight { "" } else { "+" };
                let calls = if self.calls { " and a call" } else { "" };
                write!(f, "{n}{branches}{calls}")
            }
        }
    }
}

/// What an instruction is to an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// Part of it.
    Work,
    /// A plain load or store through a pointer.
    Memory,
    /// Of the function around it: a copy, a constant, the frame, the return.
    Free,
}

fn x86(instruction: &Instruction) -> Kind {
    let mnemonic = instruction.mnemonic.as_str();
    let operands: Vec<&str> = instruction.list().collect();
    let address = operands.iter().find(|operand| operand.contains('['));
    let base = |name: &str| address.is_some_and(|address| address.contains(name));
    let name = mnemonic.strip_prefix('v').unwrap_or(mnemonic);
    let moves = match name {
        // Between registers these put a lane among others, or change from one file to another.
        "movss" | "movsd" | "movd" | "movq" => address.is_some(),
        "mov" | "movabs" | "movaps" | "movups" | "movapd" | "movupd" => true,
        "kmovb" | "kmovw" | "kmovd" | "kmovq" => true,
        _ => name.starts_with("movdqa") || name.starts_with("movdqu"),
    };
    // A constant may be loaded in one go with its spreading.
    let spreads = name.contains("broadcast")
        || ["movddup", "pmovsx", "pmovzx", "lea"].iter().any(|start| name.starts_with(start));
    // All zeros and all ones are made from whatever a register holds.
    let from_itself = ["xor", "pxor", "pcmpeq", "pternlog", "kxnor", "kxor"];
    let registers = || operands.iter().filter(|operand| operand.parse::<i64>().is_err());
    let constant = registers().count() > 1
        && (!name.starts_with("pternlog") || operands.last() == Some(&"255"))
        && registers().all(|register| *register == operands[0])
        && from_itself.iter().any(|start| name.starts_with(start));
    match mnemonic {
        "ret" | "vzeroupper" | "push" | "pop" | "nop" => Kind::Free,
        // A masked one chooses.
        _ if moves && instruction.operands.contains("{k") => Kind::Work,
        _ if operands.first() == Some(&"rsp") || constant => Kind::Free,
        _ if moves || spreads => match address {
            Some(_) if base("[rip") => Kind::Free,
            _ if spreads => Kind::Work,
            Some(_) if !base("[rsp") && !base("[rbp") => Kind::Memory,
            _ => Kind::Free,
        },
        _ => Kind::Work,
    }
}

/// The general registers of AArch64 that only ever hold constants.
fn immediates(function: &Function) -> HashSet<&str> {
    let sets = |constant: bool| {
        let code = function.code.iter().filter(move |code| {
            let immediate = code.operands.contains('#');
            (["mov", "movk"].contains(&code.mnemonic.as_str()) && immediate) == constant
        });
        code.filter_map(|code| code.list().next()).filter(|first| first.starts_with('w'))
    };
    let others: HashSet<&str> = sets(false).collect();
    sets(true).filter(|register| !others.contains(register)).collect()
}

fn arm(instruction: &Instruction, immediates: &HashSet<&str>) -> Kind {
    let Instruction { mnemonic, operands } = instruction;
    let lane =
        operands.contains("b[") || ["h[", "s[", "d["].iter().any(|size| operands.contains(size));
    let immediate = operands.contains('#');
    match mnemonic.as_str() {
        "ret" | "nop" | "movi" | "mvni" | "movk" | "movz" | "movn" | "adrp" => Kind::Free,
        _ if operands.starts_with("sp,") || operands.contains(":lo12:") => Kind::Free,
        "add" if operands.starts_with("x29, sp") => Kind::Free,
        "fmov" if immediate => Kind::Free,
        "mov" if !lane => Kind::Free,
        "dup" if instruction.list().any(|operand| immediates.contains(operand)) => Kind::Free,
        "ldr" | "ldur" | "ldp" | "str" | "stur" | "stp" if operands.contains("[sp") => Kind::Free,
        "ldr" | "ldur" | "ldp" | "str" | "stur" | "stp" => Kind::Memory,
        "ld1" | "st1" if !lane && !operands.contains("}[") => Kind::Memory,
        _ => Kind::Work,
    }
}

fn wasm(instruction: &Instruction) -> Kind {
    let mnemonic = instruction.mnemonic.as_str();
    match mnemonic.split_once('.') {
        Some(("local" | "global", _)) | Some((_, "const")) => Kind::Free,
        Some((_, "load" | "store")) => Kind::Memory,
        None if mnemonic.starts_with("end_") => Kind::Free,
        None if ["block", "loop", "return", "drop"].contains(&mnemonic) => Kind::Free,
        _ => Kind::Work,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(arch: Arch, code: &str, about_memory: bool) -> String {
        let listing = Listing::parse(&format!("\t.type f,@function\nf:\n{code}\n"));
        Count::of(&listing.functions[0], arch, &listing, about_memory).to_string()
    }

    #[test]
    fn copies_constants_and_the_frame_are_free_on_x86() {
        for (code, shown) in [
            ("movaps xmm3, xmm0\naddps xmm3, xmm1", "`addps`"),
            ("vpxor xmm1, xmm1, xmm1\nvpcmpeqd ymm0, ymm0, ymm1\nvzeroupper", "`vpcmpeqd`"),
            ("vbroadcastss ymm1, dword ptr [rip + .LCPI1_0]\nvandps ymm0, ymm0, ymm1", "`vandps`"),
            ("vbroadcastss ymm0, xmm0", "`vbroadcastss`"),
            ("vpternlogd zmm1, zmm1, zmm1, 255\nvpxord zmm0, zmm0, zmm1", "`vpxord`"),
            (
                "sub rsp, 24\nmovaps xmmword ptr [rsp], xmm0\nmovss xmm0, xmm1\nadd rsp, 24",
                "`movss`",
            ),
            ("xorps xmm0, xmm1\nxor eax, eax\nsete al", "`xorps sete`"),
            ("vpternlogq zmm0, zmm0, zmm0, 15", "`vpternlogq`"),
            ("vmovaps zmm0 {k1}, zmmword ptr [rdi]", "`vmovaps`"),
            ("", "0"),
            ("por xmm0, xmm1\npor xmm0, xmm1\npor xmm0, xmm1\npor xmm0, xmm1\npor xmm0, xmm1", "5"),
        ] {
            assert_eq!(count(Arch::X86, &format!("{code}\nret"), false), shown, "{code}");
        }
    }

    #[test]
    fn loads_and_checks_count_where_they_are_the_operation() {
        let code = "cmp rsi, 3\njbe .LBB0_2\nmovups xmm0, xmmword ptr [rdi]\nret\n.LBB0_2:\n\
                    mov edi, 4\ncall qword ptr [rip + _RNvNtCs1_4core9panicking5panic@GOTPCREL]";
        assert_eq!(count(Arch::X86, code, true), "`cmp jbe movups`");
        assert_eq!(count(Arch::X86, code, false), "`cmp jbe`");
    }

    #[test]
    fn branches_that_both_return_leave_a_number_only() {
        let code = "test edi, edi\nje .LBB0_2\naddps xmm0, xmm1\n.LBB0_2:\nret";
        assert_eq!(count(Arch::X86, code, false), "3+");
        let code = "test edi, edi\nje .LBB0_2\ncall memcpy@PLT\n.LBB0_2:\nret";
        assert_eq!(count(Arch::X86, code, false), "3+ and a call");
    }

    #[test]
    fn copies_and_constants_are_free_on_aarch64() {
        for (code, shown) in [
            (
                "adrp x8, .LCPI0_0\nldr q1, [x8, :lo12:.LCPI0_0]\nand v0.16b, v0.16b, v1.16b",
                "`and`",
            ),
            ("mov v2.16b, v0.16b\nmovi v1.4s, #128, lsl #24\nbif v0.16b, v2.16b, v1.16b", "`bif`"),
            (
                "mov w8, #52429\nmovk w8, #15820, lsl #16\ndup v2.4s, w8\ndup v1.4s, w0\n\
                 fmul v0.4s, v1.4s, v2.4s",
                "`dup fmul`",
            ),
            ("mov v0.s[1], v1.s[0]", "`mov`"),
            (
                "str q0, [sp, #-16]!\nldr q1, [x0]\nfadd v0.4s, v0.4s, v1.4s\nadd sp, sp, #16",
                "`fadd`",
            ),
        ] {
            assert_eq!(count(Arch::Arm, &format!("{code}\nret"), false), shown, "{code}");
        }
    }

    #[test]
    fn what_jumps_over_a_panic_is_straight_on() {
        let code = "block\nlocal.get 1\ni32.const 3\ni32.gt_u\nbr_if 0\ncall p\nunreachable\n\
                    end_block\nlocal.get 0\nv128.load 0";
        assert_eq!(count(Arch::Wasm, code, true), "`i32.gt_u br_if v128.load`");
    }

    #[test]
    fn the_stack_machines_own_are_free_on_webassembly() {
        let code = "local.get 0\nlocal.get 1\nv128.load 0\nv128.const 1, 2\nf32x4.add\n\
                    f32x4.min";
        assert_eq!(count(Arch::Wasm, code, false), "`f32x4.add f32x4.min`");
    }
}
