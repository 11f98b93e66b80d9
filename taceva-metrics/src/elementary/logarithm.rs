//! ln x by + − × ÷ alone, because the logarithms of platforms differ in their last bits.

use super::exponential::LN_2;

/// ln x, with an error of a few roundings; −∞ for 0, and NaN for negative x.
#[must_use]
pub fn logarithm(x: f64) -> f64 {
    /// Factor that scales subnormal numbers into the normal range.
    const RAISED: f64 = 18_014_398_509_481_984.0;
    const RAISED_BY: f64 = 54.0;
    if x.is_nan() || x < 0.0 {
        return f64::NAN;
    }
    if x <= 0.0 {
        return f64::NEG_INFINITY;
    }
    if x.is_infinite() {
        return x;
    }
    let (x, raised_by) = match x < f64::MIN_POSITIVE {
        true => (x * RAISED, RAISED_BY),
        false => (x, 0.0),
    };
    let (mut part, mut twos) = parted(x);
    if part > std::f64::consts::SQRT_2 {
        part /= 2.0;
        twos += 1.0;
    }
    let twos = twos - raised_by;
    // ln m = 2 (s + s³/3 + s⁵/5 + …), |s| ≤ 0.172: the 14th term is below 2⁻⁷⁰.
    let slope = (part - 1.0) / (part + 1.0);
    let square = slope * slope;
    let mut odd = 27.0;
    let mut sum = 0.0;
    while odd >= 1.0 {
        sum = 1.0 / odd + square * sum;
        odd -= 2.0;
    }
    twos * LN_2[0] + (2.0 * slope * sum + twos * LN_2[1])
}

/// Mantissa in 1..2 and binary exponent of a positive normal `x` = mantissa × 2^exponent.
fn parted(x: f64) -> (f64, f64) {
    const DIGITS: u64 = (1 << 52) - 1;
    const ONE: u64 = 1023 << 52;
    let bits = x.to_bits();
    let exponent = u32::try_from(bits >> 52).expect("eleven bits of a number above 0");
    (
        f64::from_bits(bits & DIGITS | ONE),
        f64::from(exponent) - 1023.0,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_agrees_with_the_machine_s() {
        for step in -7400..=7090 {
            let x = (f64::from(step) / 10.0).exp();
            let off = (logarithm(x) - x.ln()).abs();
            // A few roundings.
            assert!(off <= 4.5e-16 * x.ln().abs().max(0.1), "{x}: {off}");
        }
    }

    #[test]
    fn near_one_no_digit_is_lost() {
        for step in 1..=2000 {
            let x = 1.0 + f64::from(step) * 1e-9;
            let quotient = logarithm(x) / (x - 1.0).ln_1p();
            assert!((quotient - 1.0).abs() < 1e-15, "{x}: {quotient}");
        }
        assert_eq!(logarithm(1.0).to_bits(), 0.0_f64.to_bits());
    }

    #[test]
    fn what_has_no_logarithm_is_said() {
        assert_eq!(logarithm(0.0).to_bits(), f64::NEG_INFINITY.to_bits());
        assert_eq!(logarithm(f64::INFINITY).to_bits(), f64::INFINITY.to_bits());
        assert!(logarithm(-1.0).is_nan() && logarithm(f64::NAN).is_nan());
    }
}
