//! Which levels a target's CPU has. The program `rt` knows: xtask depends on no crate of the
//! workspace, so that a broken one can't take the judge down with it.

use crate::matrix::Target;
use xshell::{Shell, cmd};

/// The levels of one machine.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct Levels {
    /// The one that a program uses unless `SIMD4_LEVEL` caps it.
    pub(crate) default: String,
    /// The others, in the machine's order.
    pub(crate) others: Vec<String>,
}

impl Levels {
    /// Asks `rt` on the target.
    pub(crate) fn of(sh: &Shell, target: &Target) -> Result<Levels, String> {
        let args = target.cargo_args();
        let json = cmd!(sh, "cargo run --quiet --locked -p rt-cli {args...} -- info --json")
            .quiet()
            .env_remove("SIMD4_LEVEL")
            .read()
            .map_err(|error| error.to_string())?;
        Levels::parse(&json).ok_or_else(|| format!("`rt info --json` lists no levels: {json:?}"))
    }

    /// Picks the levels out of `{"arch":"…","levels":["…","…"],"default_level":"…"}`. Level names
    /// need no escapes, so neither does this.
    fn parse(json: &str) -> Option<Levels> {
        let (list, _) = value(json, "levels")?.strip_prefix('[')?.split_once(']')?;
        let names: Vec<&str> = list.split(',').map(string).collect::<Option<_>>()?;
        let (default, _) = value(json, "default_level")?.split_once([',', '}'])?;
        let default = string(default).filter(|default| names.contains(default))?;
        let others = names.iter().filter(|name| **name != default);
        Some(Levels {
            default: default.to_owned(),
            others: others.map(|name| (*name).to_owned()).collect(),
        })
    }
}

/// The text from a key's value on.
fn value<'a>(json: &'a str, key: &str) -> Option<&'a str> {
    let (_, rest) = json.split_once(&format!("\"{key}\""))?;
    Some(rest.trim_start().strip_prefix(':')?.trim_start())
}

/// The contents of a string that is not empty.
fn string(json: &str) -> Option<&str> {
    let inside = json.trim().strip_prefix('"')?.strip_suffix('"')?;
    (!inside.is_empty() && !inside.contains(['"', '\\'])).then_some(inside)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn levels_are_read_in_order_and_the_default_apart() {
        let json = r#"{"arch":"x86_64","levels":["scalar","sse2","sse4.1","avx2"],"default_level":"sse4.1"}"#;
        let levels = Levels::parse(json).expect("valid");
        assert_eq!(levels.default, "sse4.1");
        assert_eq!(levels.others, ["scalar", "sse2", "avx2"]);
    }

    #[test]
    fn layout_and_order_of_keys_do_not_matter() {
        let json =
            "{\n  \"default_level\" : \"neon\",\n  \"levels\" : [\n \"scalar\",\n \"neon\" ]\n}";
        let levels = Levels::parse(json).expect("valid");
        assert_eq!((levels.default.as_str(), levels.others), ("neon", vec!["scalar".to_owned()]));
    }

    #[test]
    fn anything_else_is_refused_rather_than_tested_by_halves() {
        for json in [
            "",
            r#"{"arch":"x86_64"}"#,
            r#"{"levels":["scalar"]}"#,
            r#"{"levels":[],"default_level":"scalar"}"#,
            r#"{"levels":["scalar","default_level":"scalar"}"#,
            r#"{"levels":["scalar",],"default_level":"scalar"}"#,
            r#"{"levels":["scalar",""],"default_level":"scalar"}"#,
            r#"{"levels":"scalar","default_level":"scalar"}"#,
            r#"{"levels":["scalar"],"default_level":"avx2"}"#,
            r#"{"levels":["scalar"],"default_level":"scalar"#,
        ] {
            assert_eq!(Levels::parse(json), None, "{json}");
        }
    }
}
