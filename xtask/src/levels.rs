//! Which levels a CPU has, from two sides: what the standard library detects on this one, and what
//! a program that uses `simd4` says wherever it runs.

use crate::matrix::Levels;

/// The levels whose instructions this CPU has, weakest first. It asks the standard library, and
/// not `simd4`: xtask depends on no crate of the workspace that it judges.
pub(crate) fn of_this_cpu() -> Vec<&'static str> {
    let mut levels = vec!["scalar"];
    #[cfg(any(target_arch = "x86", target_arch = "x86_64"))]
    {
        macro_rules! has {
            ($($feature:tt)*) => { true $(&& std::arch::is_x86_feature_detected!($feature))* };
        }
        let found = [
            ("sse2", has!("sse2")),
            ("sse4.1", has!("sse4.1")),
            ("avx2", has!("avx2" "fma" "bmi1" "bmi2" "lzcnt" "popcnt" "f16c" "movbe")),
            ("avx512", has!("avx2" "avx512f" "avx512bw" "avx512cd" "avx512dq" "avx512vl")),
        ];
        levels.extend(found.iter().filter(|(_, has)| *has).map(|(name, _)| name));
    }
    #[cfg(target_arch = "aarch64")]
    levels.push("neon");
    levels
}

impl Levels {
    /// Compares them with what a program says, one a line; returns that, weakest first.
    pub(crate) fn check(self, said: &str) -> Result<Vec<String>, String> {
        let expected = match self {
            Levels::OfThisCpu => of_this_cpu(),
            Levels::OfThisCpuFrom(least) => {
                let mut levels = of_this_cpu();
                let first = levels.iter().position(|level| *level == least);
                levels.drain(1..first.unwrap_or(levels.len()));
                levels
            }
            Levels::These(levels) => levels.to_vec(),
        };
        let said: Vec<&str> = said.lines().map(str::trim).collect();
        if said == expected {
            return Ok(said.into_iter().map(str::to_owned).collect());
        }
        let list = |levels: &[&str]| levels.join(", ");
        Err(format!("its levels are {}, and should be {}", list(&said), list(&expected)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_very_same_levels_will_do() {
        let levels = Levels::These(&["scalar", "sse2"]);
        assert_eq!(levels.check("scalar\r\nsse2\n"), Ok(vec!["scalar".into(), "sse2".into()]));
        for said in ["", "scalar\n", "scalar\nsse2\nsse4.1\n", "sse2\nscalar\n"] {
            let error = levels.check(said).expect_err(said);
            assert!(error.ends_with("should be scalar, sse2"), "{error}");
        }
    }

    #[test]
    fn a_build_that_guarantees_more_has_none_of_the_lesser_levels() {
        let [first, .., best] = of_this_cpu()[..] else { return };
        let levels = Levels::OfThisCpuFrom(best);
        assert!(levels.check(&format!("{first}\n{best}\n")).is_ok());
        assert!(levels.check(&of_this_cpu().join("\n")).is_err() || of_this_cpu().len() == 2);
    }

    #[test]
    fn this_cpu_has_the_definition_and_what_its_architecture_promises() {
        let levels = of_this_cpu();
        assert_eq!(levels[0], "scalar");
        if cfg!(target_arch = "x86_64") {
            assert_eq!(levels[1], "sse2");
        }
    }
}
