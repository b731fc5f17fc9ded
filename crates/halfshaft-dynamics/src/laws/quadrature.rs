//! Gauss-Legendre quadrature with 20 points, for averages over smooth parts of a swing.
//!
//! Over a part of at most half a turn, products of cosines up to the eighth order come out to
//! rounding. Nodes and weights: Abramowitz and Stegun, table 25.4.

/// Positive nodes on `[-1, 1]` and their weights; the rule is symmetric.
const HALF_RULE: [(f64, f64); 10] = [
    (0.076_526_521_133_497_333_754_640_4, 0.152_753_387_130_725_850_698_084_3),
    (0.227_785_851_141_645_078_080_496_2, 0.149_172_986_472_603_746_787_828_7),
    (0.373_706_088_715_419_560_672_548_2, 0.142_096_109_318_382_051_329_298_3),
    (0.510_867_001_950_827_098_004_364_1, 0.131_688_638_449_176_626_898_494_5),
    (0.636_053_680_726_515_025_452_836_7, 0.118_194_531_961_518_417_312_377_4),
    (0.746_331_906_460_150_792_614_305_1, 0.101_930_119_817_240_435_036_750_1),
    (0.839_116_971_822_218_823_394_529_1, 0.083_276_741_576_704_748_724_758_1),
    (0.912_234_428_251_325_905_867_752_4, 0.062_672_048_334_109_063_569_506_5),
    (0.963_971_927_277_913_791_267_666_1, 0.040_601_429_800_386_941_331_040_0),
    (0.993_128_599_185_094_924_786_122_4, 0.017_614_007_139_152_118_311_862_0),
];

/// Calls `add(point, weight)` for each point of the rule on `[from, to]`; the weights sum to
/// `to - from`.
#[inline]
pub(super) fn for_points(from: f64, to: f64, mut add: impl FnMut(f64, f64)) {
    let (middle, half) = (0.5 * (from + to), 0.5 * (to - from));
    for (node, weight) in HALF_RULE {
        add(middle - half * node, half * weight);
        add(middle + half * node, half * weight);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    // Source: a rule of n points is exact for powers up to 2 n - 1; integrals by hand.
    #[test]
    fn powers_up_to_39_are_exact() {
        for power in 0..=39 {
            let mut sum = 0.0;
            for_points(0.0, 1.0, |x, weight| sum += weight * x.powi(power));
            assert!((sum * f64::from(power + 1) - 1.0).abs() < 1e-14, "power {power}: {sum}");
        }
    }

    // Source: integrals of cosines over half a turn by hand.
    #[test]
    fn cosines_over_half_a_turn_are_exact() {
        for order in 0..=8 {
            let (from, to) = (0.3_f64, 0.3 + std::f64::consts::PI);
            let mut sum = 0.0;
            for_points(from, to, |x, weight| sum += weight * (f64::from(order) * x).cos());
            let exact = match order {
                0 => to - from,
                _ => {
                    let n = f64::from(order);
                    ((n * to).sin() - (n * from).sin()) / n
                }
            };
            assert!((sum - exact).abs() < 2e-14, "order {order}: {sum} {exact}");
        }
    }
}
