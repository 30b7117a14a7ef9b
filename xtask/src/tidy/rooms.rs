//! Some words may stand in some rooms only.

use crate::report::Done;
use proc_macro2::{TokenStream, TokenTree};
use std::fs;
use xshell::{Shell, cmd};

/// Words that are kept in rooms.
struct Rule {
    /// What they are.
    what: &'static str,
    /// Whether an identifier is one of them.
    is: fn(&str) -> bool,
    /// The rooms: what the names of their files start with.
    rooms: &'static [&'static str],
}

/// The rules. Comments and strings are free: a level has a name for everyone.
const RULES: [Rule; 2] = [
    Rule {
        what: "an instruction set's name",
        is: is_isa,
        rooms: &[
            "simd4/src/arch/",
            // Where levels are named, found and chosen.
            "simd4/src/level.rs",
            "simd4/src/dispatch.rs",
            // What is tested and measured one level at a time, against intrinsics and other crates.
            "simd4/tests/",
            "simd4/benches/",
            "simd4/compare/",
            "simd4/probe/",
            "xtask/",
        ],
    },
    Rule {
        what: "`unsafe`",
        is: |word| word == "unsafe",
        rooms: &["simd4/", "rt-kernels/src/collect.rs", "xtask/peers/", "xtask/src/asm/"],
    },
];

/// Whether an identifier speaks of an instruction set or of a way to ask for one.
fn is_isa(word: &str) -> bool {
    const PARTS: [&str; 14] = [
        "sse2",
        "sse3",
        "sse4",
        "avx",
        "neon",
        "simd128",
        "altivec",
        "x86",
        "aarch64",
        "wasm32",
        "powerpc",
        "s390x",
        "target_arch",
        "target_feature",
    ];
    let word = word.to_lowercase();
    word.starts_with("_mm") || PARTS.iter().any(|part| word.contains(part))
}

/// Checks every source file that git knows or would add.
pub(crate) fn rooms(sh: &Shell) -> Done {
    let files = cmd!(sh, "git ls-files --cached --others --exclude-standard *.rs").quiet().read();
    let files = match files {
        Ok(files) => files,
        Err(error) => return Done::skipped(format!("a list of the files takes git: {error}")),
    };
    let mut wrong = Vec::new();
    // A file that was removed and not yet committed is still in git's list.
    let there = files
        .lines()
        .filter_map(|name| Some((name, fs::read_to_string(sh.current_dir().join(name)).ok()?)));
    for (name, text) in there {
        wrong.extend(strangers(name, &text));
    }
    if wrong.is_empty() { Ok(()).into() } else { Err(wrong.join("\n      ")).into() }
}

/// The words in a file that belong in another room, with their places.
fn strangers(name: &str, text: &str) -> Vec<String> {
    let rules: Vec<_> =
        RULES.iter().filter(|rule| !rule.rooms.iter().any(|room| name.starts_with(room))).collect();
    let tokens = match text.parse::<TokenStream>() {
        Ok(tokens) => tokens,
        Err(error) => return vec![format!("{name}: {error}")],
    };
    let mut words = Vec::new();
    identifiers(tokens, &mut words);
    let mut wrong = Vec::new();
    for (line, word) in words {
        for Rule { what, rooms, .. } in rules.iter().filter(|rule| (rule.is)(&word)) {
            let rooms = rooms.join(", ");
            wrong.push(format!("{name}:{line}: `{word}`: {what} belongs in {rooms}"));
        }
    }
    wrong
}

/// All identifiers, keywords too, with their lines.
fn identifiers(tokens: TokenStream, words: &mut Vec<(usize, String)>) {
    for token in tokens {
        match token {
            TokenTree::Group(group) => identifiers(group.stream(), words),
            TokenTree::Ident(word) => words.push((word.span().start().line, word.to_string())),
            TokenTree::Punct(_) | TokenTree::Literal(_) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strangers_are_found_with_their_lines() {
        let text =
            "fn f() {\n    if cfg!(target_arch = \"x86\") {\n        unsafe { g() }\n    }\n}\n";
        let found = strangers("rt-kernels/src/lib.rs", text);
        assert_eq!(found.len(), 2, "{found:?}");
        assert!(found[0].starts_with("rt-kernels/src/lib.rs:2: `target_arch`"), "{found:?}");
        assert!(found[1].starts_with("rt-kernels/src/lib.rs:3: `unsafe`"), "{found:?}");
        assert!(strangers("simd4/src/arch/scalar.rs", text).is_empty());
        assert!(strangers("rt-cli/src/main.rs", "fn f( {").len() == 1, "what does not parse");
    }

    #[test]
    fn comments_strings_and_lints_are_free() {
        let text = "//! On AVX2 `unsafe`.\n#![forbid(unsafe_code)]\nconst A: &str = \"sse4.1\";\n\
                    /* neon */ fn assess(message: u8) {}\n/// x86\nfn b() {}\n";
        assert_eq!(strangers("rt-kernels/src/lib.rs", text), [""; 0]);
    }
}
