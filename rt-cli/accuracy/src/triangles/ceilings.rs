//! What triangle tests were found to get wrong, at most.

use crate::ceiling::{Ceiling, ceiling};

/// All kernels of the catalogue: leaks, false misses, false hits of a million rays; 99 % of the errors
/// of `t` in units in the last place; the band.
#[rustfmt::skip]
pub(super) const CEILINGS: [Ceiling; 37] = [
    ceiling("moller-trumbore", "division", [240650.0, 636660.0, 789030.0, 3.0, 614.1]),
    ceiling("moller-trumbore", "refined", [246380.0, 639910.0, 798300.0, 3.2, 614.1]),
    ceiling("moller-trumbore", "estimate", [253980.0, 672840.0, 786950.0, 4096.0, 5104.2]),
    ceiling("moller-trumbore", "division, fused", [258200.0, 644060.0, 662020.0, 2.7, 481.5]),
    ceiling("moller-trumbore", "refined, fused", [258120.0, 644010.0, 675270.0, 2.7, 481.5]),
    ceiling("moller-trumbore", "estimate, fused", [268160.0, 753710.0, 570220.0, 4096.0, 5104.2]),
    ceiling("wald", "division", [147040.0, 594510.0, 752380.0, 2.7, 4.1]),
    ceiling("wald", "refined", [147450.0, 595630.0, 756600.0, 2.9, 4.1]),
    ceiling("wald", "estimate", [281010.0, 762740.0, 746970.0, 3392.0, 5668.3]),
    ceiling("wald", "division, fused", [272980.0, 692690.0, 616950.0, 2.6, 3.8]),
    ceiling("wald", "refined, fused", [272980.0, 693990.0, 624550.0, 2.7, 4.1]),
    ceiling("wald", "estimate, fused", [281590.0, 763080.0, 530790.0, 3392.0, 5668.3]),
    ceiling("plucker", "division", [14300.0, 605970.0, 851060.0, 2.5, 513.3]),
    ceiling("plucker", "refined", [14300.0, 605970.0, 851060.0, 2.8, 513.3]),
    ceiling("plucker", "estimate", [14300.0, 605970.0, 851060.0, 4096.0, 513.3]),
    ceiling("plucker", "division, fused", [26350.0, 697470.0, 726000.0, 2.3, 348.9]),
    ceiling("plucker", "refined, fused", [26410.0, 701560.0, 726000.0, 2.4, 348.9]),
    ceiling("plucker", "estimate, fused", [26410.0, 701560.0, 726000.0, 4096.0, 348.9]),
    ceiling("watertight", "division, exact zeros", [0.0, 245010.0, 732600.0, 2.7, 3.1]),
    ceiling("watertight", "refined, exact zeros", [0.0, 245010.0, 733820.0, 2.9, 3.1]),
    ceiling("watertight", "estimate, exact zeros", [0.0, 245010.0, 733820.0, 3392.0, 3.1]),
    ceiling("watertight", "division", [0.0, 245010.0, 732600.0, 2.7, 3.1]),
    ceiling("watertight", "refined", [0.0, 245010.0, 733820.0, 2.9, 3.1]),
    ceiling("watertight", "estimate", [0.0, 245010.0, 733820.0, 3392.0, 3.1]),
    ceiling("watertight", "division, fused, products compared", [0.0, 637080.0, 540420.0, 2.6, 2.4]),
    ceiling("watertight", "refined, fused, products compared", [0.0, 644980.0, 547550.0, 2.7, 2.4]),
    ceiling("watertight", "estimate, fused, products compared", [0.0, 644980.0, 547550.0, 3456.0, 2.4]),
    ceiling("watertight", "division, fused, Kahan", [0.0, 637080.0, 540420.0, 2.6, 2.4]),
    ceiling("watertight", "refined, fused, Kahan", [0.0, 644980.0, 547550.0, 2.7, 2.4]),
    ceiling("watertight", "estimate, fused, Kahan", [0.0, 644980.0, 547550.0, 3456.0, 2.4]),
    ceiling("watertight", "division, fused", [5100.0, 637080.0, 540420.0, 2.6, 2.4]),
    ceiling("watertight", "refined, fused", [5250.0, 644980.0, 547550.0, 2.7, 2.4]),
    ceiling("watertight", "estimate, fused", [5250.0, 644980.0, 547550.0, 3456.0, 2.4]),
    ceiling("moller-trumbore", "division, signs first", [240670.0, 636690.0, 773800.0, 3.0, 614.1]),
    ceiling("moller-trumbore", "division, fused, signs first", [258260.0, 644110.0, 625280.0, 2.7, 481.5]),
    ceiling("watertight", "division, exact zeros, own box", [0.0, 245010.0, 732600.0, 2.7, 3.1]),
    ceiling("moller-trumbore-f64", "division", [3610.0, 93760.0, 70.0, 0.5, 0.1]),
];
