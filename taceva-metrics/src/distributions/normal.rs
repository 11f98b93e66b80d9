//! Normal distribution with mean 0 and variance 1.

use std::f64::consts::TAU;

use super::gamma::gamma_tails;
use crate::elementary::exponential;
use crate::elementary::logarithm;

/// Probability P(Z ≤ z) of a standard normal Z.
///
/// ```
/// use taceva_metrics::distributions::normal;
/// assert!((normal::below(-1.644_853_626_951_472_7) - 0.05).abs() < 1e-16);
/// ```
#[must_use]
pub fn below(z: f64) -> f64 {
    above(-z)
}

/// Probability P(Z > z) of a standard normal Z. A small result has full relative accuracy.
///
/// ```
/// use taceva_metrics::distributions::normal;
/// assert!((normal::above(10.0) / 7.619_853_024_160_527e-24 - 1.0).abs() < 1e-13);
/// ```
#[must_use]
pub fn above(z: f64) -> f64 {
    let tails = gamma_tails(0.5, z * z / 2.0);
    if z < 0.0 {
        0.5 + tails.below / 2.0
    } else {
        tails.above / 2.0
    }
}

/// Density of the standard normal distribution at z.
///
/// ```
/// use taceva_metrics::distributions::normal;
/// assert!((normal::density(0.0) - 0.398_942_280_401_432_7).abs() < 1e-16);
/// ```
#[must_use]
pub fn density(z: f64) -> f64 {
    exponential(-z * z / 2.0) / TAU.sqrt()
}

/// Quantile: z with P(Z ≤ z) = `share` for a standard normal Z. The result is infinite for 0 and 1, and NaN outside 0..1.
///
/// ```
/// use taceva_metrics::distributions::normal;
/// assert!((normal::quantile(0.975) - 1.959_963_984_540_054).abs() < 1e-15);
/// ```
///
/// # Reference
/// Wichura, The percentage points of the normal distribution, AS 241, Applied Statistics 37 (1988).
#[must_use]
pub fn quantile(share: f64) -> f64 {
    if share.is_nan() || !(0.0..=1.0).contains(&share) {
        return f64::NAN;
    }
    let off = share - 0.5;
    if off.abs() <= 0.425 {
        let r = 0.180_625 - off * off;
        return off * MIDDLE.at(r);
    }
    let tail = if off < 0.0 { share } else { 1.0 - share };
    if tail <= 0.0 {
        return f64::INFINITY.copysign(off);
    }
    let r = (-logarithm(tail)).sqrt();
    let z = if r <= 5.0 {
        NEAR.at(r - 1.6)
    } else {
        FAR.at(r - 5.0)
    };
    z.copysign(off)
}

/// Quotient of two polynomials, with coefficients from the constant term up. The constant term of the divisor is 1.
struct Quotient {
    above: [f64; 8],
    below: [f64; 7],
}

impl Quotient {
    fn at(&self, r: f64) -> f64 {
        let above = self.above.iter().rev().fold(0.0, |sum, one| sum * r + one);
        let below = self.below.iter().rev().fold(0.0, |sum, one| sum * r + one);
        above / (below * r + 1.0)
    }
}

const MIDDLE: Quotient = Quotient {
    above: [
        3.387_132_872_796_366_5,
        1.331_416_678_917_843_8e2,
        1.971_590_950_306_551_3e3,
        1.373_169_376_550_946_2e4,
        4.592_195_393_154_987e4,
        6.726_577_092_700_87e4,
        3.343_057_558_358_813e4,
        2.509_080_928_730_122_7e3,
    ],
    below: [
        4.231_333_070_160_091e1,
        6.871_870_074_920_579e2,
        5.394_196_021_424_751e3,
        2.121_379_430_158_659_7e4,
        3.930_789_580_009_271e4,
        2.872_908_573_572_194_3e4,
        5.226_495_278_852_854e3,
    ],
};

const NEAR: Quotient = Quotient {
    above: [
        1.423_437_110_749_683_5,
        4.630_337_846_156_546,
        5.769_497_221_460_691,
        3.647_848_324_763_204_5,
        1.270_458_252_452_368_4,
        2.417_807_251_774_506e-1,
        2.272_384_498_926_918_4e-2,
        7.745_450_142_783_414e-4,
    ],
    below: [
        2.053_191_626_637_759,
        1.676_384_830_183_803_8,
        6.897_673_349_851e-1,
        1.481_039_764_274_800_8e-1,
        1.519_866_656_361_645_7e-2,
        5.475_938_084_995_345e-4,
        1.050_750_071_644_416_9e-9,
    ],
};

const FAR: Quotient = Quotient {
    above: [
        6.657_904_643_501_103,
        5.463_784_911_164_114,
        1.784_826_539_917_291_3,
        2.965_605_718_285_048_7e-1,
        2.653_218_952_657_612_4e-2,
        1.242_660_947_388_078_4e-3,
        2.711_555_568_743_487_6e-5,
        2.010_334_399_292_288_1e-7,
    ],
    below: [
        5.998_322_065_558_88e-1,
        1.369_298_809_227_358e-1,
        1.487_536_129_085_061_5e-2,
        7.868_691_311_456_133e-4,
        1.846_318_317_510_054_8e-5,
        1.421_511_758_316_446e-7,
        2.044_263_103_389_939_8e-15,
    ],
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_give_back_their_share() {
        for share in [
            1e-300, 1e-100, 1e-20, 1e-9, 0.001, 0.05, 0.074, 0.076, 0.3, 0.5,
        ] {
            let back = below(quantile(share));
            assert!((back / share - 1.0).abs() < 4e-13, "{share}: {back}");
            if share > 1e-10 {
                let other = quantile(1.0 - share) + quantile(share);
                assert!(other.abs() < 1e-7, "{share}: {other}");
            }
        }
        assert!(quantile(0.0).is_infinite() && quantile(1.5).is_nan());
    }
}
