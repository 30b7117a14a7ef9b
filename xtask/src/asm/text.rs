//! The assembly text that rustc emits, as functions and instructions.

use rustc_demangle::demangle;
use std::collections::{HashMap, HashSet};

/// Whose assembly it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Arch {
    /// x86-64, in Intel's syntax.
    X86,
    /// AArch64.
    Arm,
    /// WebAssembly, in LLVM's syntax.
    Wasm,
}

/// What one file of assembly defines.
#[derive(Debug, Default)]
pub(crate) struct Listing {
    /// Its functions, in their order.
    pub(crate) functions: Vec<Function>,
    /// Other names of functions that have the same body, and whose.
    pub(crate) aliases: Vec<(String, String)>,
    /// The labels that jump tables name: where an indirect jump may go.
    pub(crate) tabled: HashSet<String>,
}

/// A function.
#[derive(Debug, Default)]
pub(crate) struct Function {
    /// Its symbol, as it stands.
    pub(crate) symbol: String,
    /// Its code.
    pub(crate) code: Vec<Instruction>,
    /// Its labels, each with the index of the instruction behind it.
    pub(crate) labels: HashMap<String, usize>,
}

/// An instruction.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Instruction {
    /// Its first word.
    pub(crate) mnemonic: String,
    /// The rest.
    pub(crate) operands: String,
}

impl Instruction {
    /// The operands, one by one.
    pub(crate) fn list(&self) -> impl Iterator<Item = &str> {
        self.operands.split(',').map(str::trim).filter(|operand| !operand.is_empty())
    }

    /// The words in the operands: registers, labels, symbols.
    pub(crate) fn words(&self) -> impl Iterator<Item = &str> {
        words(&self.operands)
    }
}

impl std::fmt::Display for Instruction {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.mnemonic)?;
        let mut rest = self.operands.as_str();
        // Symbols in Rust's own words.
        for word in self.words().filter(|word| word.starts_with("_R") || word.starts_with("_ZN")) {
            if let Some((before, after)) = rest.split_once(word) {
                let gap = if rest.len() == self.operands.len() { " " } else { "" };
                write!(f, "{gap}{before}{:#}", demangle(word))?;
                rest = after;
            }
        }
        let gap = if rest.len() == self.operands.len() && !rest.is_empty() { " " } else { "" };
        write!(f, "{gap}{rest}")
    }
}

/// Everything in a line that could be a name.
fn words(line: &str) -> impl Iterator<Item = &str> {
    line.split(|c: char| !(c.is_alphanumeric() || ['_', '.', '$'].contains(&c)))
        .filter(|word| !word.is_empty())
}

impl Listing {
    /// Reads a file of assembly.
    pub(crate) fn parse(text: &str) -> Listing {
        let mut listing = Listing::default();
        // The symbols that `.type` says are functions.
        let mut declared = HashSet::new();
        let mut open: Option<Function> = None;
        let mut in_table = false;
        for line in text.lines().map(str::trim) {
            if let Some(label) = line.strip_suffix(':') {
                in_table = label.starts_with(".LJTI");
                if declared.contains(label) {
                    listing.functions.extend(open.take());
                    open = Some(Function { symbol: label.to_owned(), ..Function::default() });
                } else if let Some(function) = &mut open {
                    function.labels.insert(label.to_owned(), function.code.len());
                }
            } else if let Some(rest) = line.strip_prefix(".type") {
                if let Some((symbol, "@function")) = rest.trim().split_once(',') {
                    declared.insert(symbol.to_owned());
                }
            } else if line.starts_with(".size") || line == "end_function" {
                listing.functions.extend(open.take());
            } else if let Some(alias) = alias(line) {
                listing.aliases.push(alias);
            } else if line.starts_with('.') {
                if in_table {
                    let labels = words(line).filter(|word| word.starts_with(".LBB"));
                    listing.tabled.extend(labels.map(str::to_owned));
                }
            } else if let (Some(function), false) =
                (&mut open, line.is_empty() || line.starts_with(['#', ';']))
            {
                let (mnemonic, operands) =
                    line.split_once(char::is_whitespace).unwrap_or((line, ""));
                function.code.push(Instruction {
                    mnemonic: mnemonic.to_owned(),
                    operands: operands.trim().to_owned(),
                });
            }
        }
        listing.functions.extend(open);
        listing
    }

    /// Every function under each of its names.
    pub(crate) fn named(&self) -> HashMap<&str, &Function> {
        let mut named: HashMap<&str, &Function> =
            self.functions.iter().map(|function| (function.symbol.as_str(), function)).collect();
        for (alias, of) in &self.aliases {
            if let Some(&function) = named.get(of.as_str()) {
                named.insert(alias, function);
            }
        }
        named
    }
}

/// Reads `alias = symbol` or `.set alias, symbol`.
fn alias(line: &str) -> Option<(String, String)> {
    let (alias, of) = match line.strip_prefix(".set") {
        Some(rest) => rest.split_once(',')?,
        None => line.split_once(" = ")?,
    };
    Some((alias.trim().to_owned(), of.trim().to_owned()))
}

/// A symbol as Rust spells the path, without hashes.
pub(crate) fn path(symbol: &str) -> String {
    format!("{:#}", demangle(symbol))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn functions_labels_aliases_and_jump_tables_are_read() {
        let listing = Listing::parse(
            "\t.file\t\"a.rs\"\n\t.type\tf,@function\nf:\n\t.cfi_startproc\n\tcmp\trdi, 7\n\
             .LBB0_1:\n\tje\t.LBB0_1\n\tret\n.Lfunc_end0:\n\t.size\tf, .Lfunc_end0-f\n\
             .LJTI0_0:\n\t.long\t.LBB0_1-.LJTI0_0\n.Lother:\n\t.long\t.LBB0_9\n\
             \t.type\tg,@function\n\t.set\tg, f\n\t.globl\th\nh = f\n",
        );
        let [f] = listing.functions.as_slice() else { panic!("{listing:?}") };
        assert_eq!(f.symbol, "f");
        let code: Vec<String> = f.code.iter().map(ToString::to_string).collect();
        assert_eq!(code, ["cmp rdi, 7", "je .LBB0_1", "ret"]);
        assert_eq!(f.labels[".LBB0_1"], 1);
        assert_eq!(listing.tabled, HashSet::from([".LBB0_1".to_owned()]));
        for name in ["f", "g", "h"] {
            assert_eq!(listing.named()[name].symbol, "f");
        }
    }

    #[test]
    fn webassembly_functions_end_with_their_last_line() {
        let listing = Listing::parse(
            "\t.type\tf,@function\nf:\n\t.functype\tf (i32) -> ()\n\tblock   \t\n\
             \tlocal.get\t0\n\tend_function\n\t.type\tg,@function\ng:\n\treturn\n\tend_function\n",
        );
        let symbols: Vec<_> =
            listing.functions.iter().map(|f| (&*f.symbol, f.code.len())).collect();
        assert_eq!(symbols, [("f", 2), ("g", 1)]);
    }

    #[test]
    fn instructions_show_symbols_as_paths() {
        let call = Instruction {
            mnemonic: "call".to_owned(),
            operands: "qword ptr [rip + _RNvNtCs1_4core9panicking5panic@GOTPCREL]".to_owned(),
        };
        assert_eq!(call.to_string(), "call qword ptr [rip + core::panicking::panic@GOTPCREL]");
    }
}
