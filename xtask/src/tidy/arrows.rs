//! Which crate may use which.

use crate::report::Done;
use serde_json::Value;
use xshell::{Shell, cmd};

use Others::{Any, But, Only};

/// What a crate may use. Tests (dev-dependencies) are free in what comes from outside.
struct Arrows {
    name: &'static str,
    /// The crates of this workspace.
    uses: &'static [&'static str],
    /// The crates from outside.
    others: Others,
}

/// Crates from outside.
enum Others {
    /// All are welcome.
    Any,
    /// All but these.
    But(&'static [&'static str]),
    /// None but these.
    Only(&'static [&'static str]),
}

/// The arrows; there are no others.
#[rustfmt::skip]
const ARROWS: [Arrows; 10] = [
    Arrows { name: "simd4",      uses: &[],                                              others: Only(&[]) },
    Arrows { name: "simd4-probe", uses: &["simd4"],                                      others: Only(&[]) },
    Arrows { name: "rt-kernels", uses: &["simd4"],                                       others: But(&["rayon", "rand", "clap"]) },
    Arrows { name: "rt-picture", uses: &[],                                              others: But(&["rayon", "clap"]) },
    Arrows { name: "rt-scene",   uses: &[],                                              others: But(&["rayon", "clap"]) },
    Arrows { name: "rt-render",  uses: &["simd4", "rt-kernels", "rt-scene", "rt-picture"], others: But(&["clap", "indicatif"]) },
    Arrows { name: "rt-accuracy", uses: &["simd4", "rt-kernels", "rt-tests"],            others: But(&["clap", "indicatif"]) },
    Arrows { name: "rt-cli",     uses: &["rt-render", "rt-scene", "rt-accuracy", "rt-picture"], others: Any },
    Arrows { name: "rt-tests",   uses: &["simd4", "rt-kernels", "rt-scene", "rt-render"], others: Any },
    Arrows { name: "xtask",      uses: &[],                                              others: But(&["clap"]) },
];

/// Checks what cargo knows of the workspace against the table.
pub(crate) fn arrows(sh: &Shell) -> Done {
    let metadata = cmd!(sh, "cargo metadata --format-version 1 --no-deps --locked").quiet().read();
    let check = |json: String| {
        let json = serde_json::from_str(&json).map_err(|error| error.to_string())?;
        let wrong = wrong(&json);
        if wrong.is_empty() { Ok(()) } else { Err(wrong.join("\n      ")) }
    };
    metadata.map_err(|error| error.to_string()).and_then(check).into()
}

/// The arrows that should not be there.
fn wrong(metadata: &Value) -> Vec<String> {
    let list = |value: &Value| value.as_array().cloned().unwrap_or_default();
    let name = |value: &Value| value["name"].as_str().unwrap_or_default().to_owned();
    let packages = list(&metadata["packages"]);
    let ours: Vec<String> = packages.iter().map(name).collect();
    let mut wrong = Vec::new();
    for package in &packages {
        let from = name(package);
        let Some(arrows) = ARROWS.iter().find(|arrows| arrows.name == from) else {
            wrong.push(format!("{from} has no line in xtask/src/tidy/arrows.rs"));
            continue;
        };
        for dependency in list(&package["dependencies"]) {
            let to = name(&dependency);
            let in_tests = dependency["kind"] == "dev";
            let allowed = if ours.contains(&to) {
                arrows.uses.contains(&to.as_str())
            } else {
                in_tests
                    || match arrows.others {
                        Any => true,
                        But(names) => !names.contains(&to.as_str()),
                        Only(names) => names.contains(&to.as_str()),
                    }
            };
            if !allowed {
                wrong.push(format!("{from} must not use {to}"));
            }
        }
    }
    wrong
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(from: &str, to: &str, kind: &str) -> Vec<String> {
        wrong(&serde_json::json!({ "packages": [
            { "name": from, "dependencies": [{ "name": to, "kind": kind }] },
            { "name": "simd4", "dependencies": [] },
            { "name": "rt-kernels", "dependencies": [] },
        ] }))
    }

    #[test]
    fn arrows_of_the_table_are_allowed_and_no_others() {
        for (from, to, kind) in [
            ("rt-render", "rt-kernels", ""),
            ("rt-cli", "clap", ""),
            ("rt-scene", "tobj", ""),
            ("rt-scene", "clap", "dev"),
        ] {
            assert_eq!(check(from, to, kind), [""; 0], "{from} -> {to}");
        }
        for (from, to, kind) in [
            ("rt-cli", "simd4", ""),
            ("rt-scene", "rt-kernels", ""),
            ("rt-scene", "simd4", "dev"),
            ("rt-render", "clap", ""),
            ("xtask", "simd4", "build"),
        ] {
            assert_eq!(check(from, to, kind), [format!("{from} must not use {to}")]);
        }
    }

    #[test]
    fn simd4_is_alone_and_a_new_crate_takes_a_place() {
        let with = |name: &str, to: &str| {
            serde_json::json!({ "packages": [
                { "name": name, "dependencies": [{ "name": to, "kind": null }] },
            ] })
        };
        assert_eq!(wrong(&with("simd4", "libm")), ["simd4 must not use libm"]);
        assert_eq!(wrong(&with("rt-new", "libm")).len(), 1);
    }
}
