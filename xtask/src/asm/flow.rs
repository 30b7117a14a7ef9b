//! Where control goes from each instruction of a function.
//!
//! An instruction is **in a loop** if it can be reached from itself within its function. The
//! paths that end in a panic lead nowhere, so they are in no loop, wherever the text has them.

use super::text::{Arch, Function, Instruction, path};
use std::collections::HashSet;

/// The control flow of a function.
#[derive(Debug)]
pub(crate) struct Flow {
    /// For each instruction those that may follow.
    next: Vec<Vec<usize>>,
    /// Whether the function may return there, or leave for another.
    exit: Vec<bool>,
}

/// What an instruction does to the flow.
enum Step {
    /// Goes on.
    On,
    /// Goes there.
    Jump(Vec<usize>),
    /// Goes there or on.
    Branch(Vec<usize>),
    /// Returns, or leaves for another function.
    Exit,
    /// Goes nowhere.
    Trap,
}

impl Flow {
    /// Follows a function. `tabled` are the labels that jump tables name.
    pub(crate) fn of(function: &Function, arch: Arch, tabled: &HashSet<String>) -> Flow {
        let mut flow = Flow { next: Vec::new(), exit: Vec::new() };
        let blocks = if arch == Arch::Wasm { blocks(function) } else { Vec::new() };
        for (i, instruction) in function.code.iter().enumerate() {
            let step = match (arch, call(instruction, arch)) {
                (_, Some(callee)) if callee.is_some_and(never_returns) => Step::Trap,
                (_, Some(_)) => Step::On,
                (Arch::X86, None) => x86(instruction, function, tabled),
                (Arch::Arm, None) => arm(instruction, function, tabled),
                (Arch::Wasm, None) => wasm(instruction, &blocks[i]),
            };
            let on = i + 1;
            let (mut next, mut exit) = match step {
                Step::On => (vec![on], false),
                Step::Jump(to) => (to, false),
                Step::Branch(to) => ([vec![on], to].concat(), false),
                Step::Exit => (vec![], true),
                Step::Trap => (vec![], false),
            };
            // A WebAssembly function returns at its end, and so does a branch out of all blocks.
            if next.iter().any(|&to| to >= function.code.len()) {
                exit = arch == Arch::Wasm;
                next.retain(|&to| to < function.code.len());
            }
            flow.next.push(next);
            flow.exit.push(exit);
        }
        flow
    }

    /// Whether an instruction is in a loop.
    pub(crate) fn in_loop(&self, at: usize) -> bool {
        let mut seen = vec![false; self.next.len()];
        let mut open = self.next[at].clone();
        while let Some(i) = open.pop() {
            if i == at {
                return true;
            }
            if !std::mem::replace(&mut seen[i], true) {
                open.extend(&self.next[i]);
            }
        }
        false
    }

    /// For each instruction whether the function can return from there: not on the way to a panic.
    pub(crate) fn returning(&self) -> Vec<bool> {
        let mut returning = self.exit.clone();
        loop {
            let mut grown = false;
            for i in (0..self.next.len()).rev() {
                if !returning[i] && self.next[i].iter().any(|&to| returning[to]) {
                    returning[i] = true;
                    grown = true;
                }
            }
            if !grown {
                return returning;
            }
        }
    }

    /// Whether what is run until the function returns does not depend on anything.
    pub(crate) fn is_straight(&self, returning: &[bool]) -> bool {
        self.next.iter().enumerate().all(|(i, next)| {
            let on: Vec<usize> = next.iter().copied().filter(|&to| returning[to]).collect();
            !returning[i] || on.iter().all(|&to| to > i && to == on[0])
        })
    }
}

/// Whether an instruction calls, and whom if it says so.
pub(crate) fn call(instruction: &Instruction, arch: Arch) -> Option<Option<&str>> {
    let operands = instruction.operands.as_str();
    match (arch, instruction.mnemonic.as_str()) {
        (Arch::X86, "call") => {
            let indirect = operands.strip_prefix("qword ptr [");
            let symbol = match indirect {
                Some(address) => address.strip_prefix("rip + "),
                // A register's name is short.
                None => Some(operands).filter(|name| name.len() > 3),
            };
            Some(symbol.and_then(|symbol| symbol.split(['@', ']']).next()))
        }
        (Arch::Arm, "bl") | (Arch::Wasm, "call") => Some(Some(operands)),
        (Arch::Arm, "blr") | (Arch::Wasm, "call_indirect") => Some(None),
        _ => None,
    }
}

/// Whether a function is known to panic, abort or go on unwinding.
pub(crate) fn never_returns(symbol: &str) -> bool {
    let path = path(symbol);
    let name = path.rsplit("::").next().unwrap_or(&path);
    path.contains("panic")
        || ["_fail", "_failed"].iter().any(|end| name.ends_with(end))
        || ["handle_error", "handle_alloc_error", "capacity_overflow", "_Unwind_Resume", "abort"]
            .contains(&name)
}

/// The labels' places, if they are the function's own; other symbols are other functions.
fn places<'a>(function: &Function, labels: impl IntoIterator<Item = &'a str>) -> Vec<usize> {
    labels.into_iter().filter_map(|label| function.labels.get(label).copied()).collect()
}

/// A jump within the function, by a table if it does not say where, or out of it.
fn jump(target: &str, indirect: bool, function: &Function, tabled: &HashSet<String>) -> Step {
    let to = match indirect {
        true => places(function, tabled.iter().map(String::as_str)),
        false => places(function, [target]),
    };
    if to.is_empty() { Step::Exit } else { Step::Jump(to) }
}

fn x86(instruction: &Instruction, function: &Function, tabled: &HashSet<String>) -> Step {
    match instruction.mnemonic.as_str() {
        "jmp" => {
            let target = instruction.operands.as_str();
            // A register's name is short; what is relative to `rip` is another function's address.
            let indirect = target.len() <= 3 || target.contains('[') && !target.contains("[rip");
            jump(target, indirect, function, tabled)
        }
        "ret" => Step::Exit,
        "ud2" | "int3" | "hlt" => Step::Trap,
        other if other.starts_with('j') => Step::Branch(places(function, instruction.words())),
        _ => Step::On,
    }
}

fn arm(instruction: &Instruction, function: &Function, tabled: &HashSet<String>) -> Step {
    match instruction.mnemonic.as_str() {
        "b" | "br" => jump(&instruction.operands, instruction.mnemonic == "br", function, tabled),
        "ret" => Step::Exit,
        "brk" | "udf" | "hlt" => Step::Trap,
        "cbz" | "cbnz" | "tbz" | "tbnz" => Step::Branch(places(function, instruction.words())),
        other if other.starts_with("b.") => Step::Branch(places(function, instruction.words())),
        _ => Step::On,
    }
}

/// For each instruction of WebAssembly where a branch by 0, 1, 2, … blocks goes.
fn blocks(function: &Function) -> Vec<Vec<usize>> {
    // Ends are known when they come: every branch notes the blocks it is in, by number.
    let mut targets: Vec<usize> = Vec::new();
    let mut open: Vec<usize> = Vec::new();
    let mut inside = Vec::new();
    for (i, instruction) in function.code.iter().enumerate() {
        match instruction.mnemonic.as_str() {
            "loop" => {
                open.push(targets.len());
                targets.push(i);
            }
            "block" | "if" | "try_table" => {
                open.push(targets.len());
                targets.push(function.code.len());
            }
            "end_loop" => drop(open.pop()),
            "end_block" | "end_if" | "end_try_table" => {
                if let Some(block) = open.pop() {
                    targets[block] = i;
                }
            }
            _ => {}
        }
        inside.push(open.clone());
    }
    inside
        .into_iter()
        .map(|open| {
            let out = [function.code.len()];
            open.iter().rev().map(|&block| targets[block]).chain(out).collect()
        })
        .collect()
}

fn wasm(instruction: &Instruction, blocks: &[usize]) -> Step {
    let targets = || {
        let depths = instruction.words().filter_map(|word| word.parse::<usize>().ok());
        depths.filter_map(|depth| blocks.get(depth).copied()).collect()
    };
    match instruction.mnemonic.as_str() {
        "br" | "br_table" => Step::Jump(targets()),
        "br_if" => Step::Branch(targets()),
        "return" | "return_call" | "return_call_indirect" => Step::Exit,
        "unreachable" => Step::Trap,
        _ => Step::On,
    }
}

#[cfg(test)]
mod tests {
    use super::super::text::Listing;
    use super::*;

    /// Which instructions are in a loop, by mnemonic.
    fn looping(arch: Arch, code: &str) -> Vec<String> {
        let listing = Listing::parse(&format!("\t.type f,@function\nf:\n{code}\n\t.size f, 1\n"));
        let function = &listing.functions[0];
        let flow = Flow::of(function, arch, &listing.tabled);
        let of = |i: usize| function.code[i].mnemonic.clone();
        (0..function.code.len()).filter(|&i| flow.in_loop(i)).map(of).collect()
    }

    const PANIC: &str = "_RNvNtCs1_4core9panicking5panic";

    #[test]
    fn x86_loops_are_found_and_panics_within_their_text_are_not_of_them() {
        let code = format!(
            "push rbx\n.LBB0_1:\ncmp rdi, rsi\njae .LBB0_3\ninc rdi\njne .LBB0_1\nret\n\
             .LBB0_3:\nlea rdi, [rip + x]\ncall qword ptr [rip + {PANIC}@GOTPCREL]\n.LBB0_4:\nud2"
        );
        assert_eq!(looping(Arch::X86, &code), ["cmp", "jae", "inc", "jne"]);
    }

    #[test]
    fn a_call_that_returns_goes_on() {
        let code = "jmp .LBB0_2\n.LBB0_1:\nmov rdi, rbx\ncall qword ptr [rip + g@GOTPCREL]\n\
                    .LBB0_2:\ntest rdi, rdi\nje .LBB0_1\njmp h";
        assert_eq!(looping(Arch::X86, code), ["mov", "call", "test", "je"]);
    }

    #[test]
    fn indirect_jumps_go_wherever_a_table_says() {
        let code = ".LBB0_1:\njmp rax\n.LBB0_2:\ninc rcx\njmp .LBB0_1\n.LBB0_3:\nret\n\
                    .LJTI0_0:\n.long .LBB0_2-.LJTI0_0\n.long .LBB0_3-.LJTI0_0";
        assert_eq!(looping(Arch::X86, code), ["jmp", "inc", "jmp"]);
    }

    #[test]
    fn aarch64_loops_are_found() {
        let code = format!(
            "cbz x9, .LBB0_4\n.LBB0_2:\nldr x8, [x2], #8\ncmp x8, x1\nb.hs .LBB0_5\nbl g\n\
             tbnz w9, #0, .LBB0_2\n.LBB0_4:\nret\n.LBB0_5:\nmov x0, x8\nbl {PANIC}"
        );
        assert_eq!(looping(Arch::Arm, &code), ["ldr", "cmp", "b.hs", "bl", "tbnz"]);
    }

    #[test]
    fn webassembly_branches_go_to_a_loops_start_and_a_blocks_end() {
        let code = format!(
            "block\nblock\nloop\nlocal.get 0\nbr_if 1\ncall g\nlocal.get 1\nbr_if 0\nend_loop\n\
             return\nend_block\ncall {PANIC}\nunreachable\nend_block\ncall h"
        );
        assert_eq!(
            looping(Arch::Wasm, &code),
            ["loop", "local.get", "br_if", "call", "local.get", "br_if"]
        );
    }

    #[test]
    fn what_only_leads_to_a_panic_does_not_return() {
        let code = format!("cmp rsi, 3\njbe .LBB0_2\nret\n.LBB0_2:\npush rax\ncall {PANIC}");
        let listing = Listing::parse(&format!("\t.type f,@function\nf:\n{code}\n"));
        let flow = Flow::of(&listing.functions[0], Arch::X86, &listing.tabled);
        assert_eq!(flow.returning(), [true, true, true, false, false]);
    }

    #[test]
    fn callees_are_named_where_the_instruction_names_them() {
        for (arch, mnemonic, operands, callee) in [
            (Arch::X86, "call", "qword ptr [rip + f@GOTPCREL]", Some(Some("f"))),
            (Arch::X86, "call", "memcpy@PLT", Some(Some("memcpy"))),
            (Arch::X86, "call", "rax", Some(None)),
            (Arch::X86, "call", "qword ptr [rax + 24]", Some(None)),
            (Arch::X86, "jmp", "f", None),
            (Arch::Arm, "bl", "f", Some(Some("f"))),
            (Arch::Arm, "blr", "x8", Some(None)),
            (Arch::Wasm, "call", "f", Some(Some("f"))),
            (Arch::Wasm, "call_indirect", "(i32) -> ()", Some(None)),
        ] {
            let instruction =
                Instruction { mnemonic: mnemonic.to_owned(), operands: operands.to_owned() };
            assert_eq!(call(&instruction, arch), callee, "{instruction}");
        }
    }
}
