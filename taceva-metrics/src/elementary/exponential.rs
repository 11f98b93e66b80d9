//! e^x by + − × ÷ alone, because the exponential functions of platforms differ in their last bits.

/// ln 2 as a sum of two parts. The first part has few digits, so its products with small integers are exact.
pub(super) const LN_2: [f64; 2] = [6.931_471_803_691_238e-1, 1.908_214_929_270_587_7e-10];

/// e^x, with an error of a few roundings; 0 or infinity beyond the range of binary64.
#[must_use]
pub fn exponential(x: f64) -> f64 {
    /// Limits of x in binary64: e^710 exceeds the greatest number, and e^−750 is below half the least positive number.
    const BEYOND: [f64; 2] = [-750.0, 710.0];
    if x.is_nan() {
        return x;
    }
    let x = x.clamp(BEYOND[0], BEYOND[1]);
    let twos = (x / (LN_2[0] + LN_2[1])).round();
    let rest = (x - twos * LN_2[0]) - twos * LN_2[1];
    // |rest| ≤ 0.35: the 18th term of the series is below 2⁻⁷⁰.
    let mut terms = 17.0;
    let mut sum = 1.0;
    while terms >= 1.0 {
        sum = 1.0 + rest / terms * sum;
        terms -= 1.0;
    }
    scaled(sum, twos)
}

/// Computes `sum` × 2^`twos` in steps, so that each power of two is within the range of binary64.
fn scaled(sum: f64, twos: f64) -> f64 {
    const STEP: f64 = 512.0;
    let (mut result, mut left) = (sum, twos);
    while left.abs() >= 1.0 {
        let step = left.clamp(-STEP, STEP);
        result *= power_of_two(step);
        left -= step;
    }
    result
}

/// 2^exponent for a whole exponent from −512 to 512.
fn power_of_two(exponent: f64) -> f64 {
    let base = if exponent < 0.0 { 0.5 } else { 2.0 };
    let (mut result, mut factor, mut left) = (1.0, base, exponent.abs());
    while left >= 1.0 {
        let half = (left / 2.0).floor();
        if left - 2.0 * half >= 1.0 {
            result *= factor;
        }
        factor *= factor;
        left = half;
    }
    result
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn it_agrees_with_the_machine_s() {
        for step in -7000..=7000 {
            let x = f64::from(step) / 10.0;
            let quotient = exponential(x) / x.exp();
            // A few roundings.
            assert!((quotient - 1.0).abs() < 2e-15, "{x}: {quotient}");
        }
    }

    #[test]
    fn one_is_exact_and_what_is_beyond_the_range_is_an_end_of_it() {
        assert_eq!(exponential(0.0).to_bits(), 1.0_f64.to_bits());
        assert_eq!(exponential(-1e300).to_bits(), 0.0_f64.to_bits());
        assert_eq!(exponential(1e300).to_bits(), f64::INFINITY.to_bits());
        assert!(exponential(f64::NAN).is_nan());
    }
}
