//! Rounding of exact results to binary64. No other code rounds exact results.

/// The binary64 nearest to `±(mantissa + rest) × 2^exponent`, ties to even, with `0 ≤ rest < 1`. `inexact` is true if `rest` is not zero.
///
/// An inexact mantissa must have at least 55 bits, two more than a binary64 keeps. Overflow gives infinity; underflow keeps the sign.
pub(super) fn round(negative: bool, mantissa: u64, inexact: bool, exponent: i32) -> f64 {
    let magnitude = round_magnitude(mantissa, inexact, exponent);
    if negative { -magnitude } else { magnitude }
}

fn round_magnitude(mantissa: u64, inexact: bool, exponent: i32) -> f64 {
    /// Exponent of two of the last place of the least normal number and of all denormals.
    const LEAST: i32 = -1074;
    if mantissa == 0 {
        return 0.0;
    }
    let leading_zeros = i32::try_from(mantissa.leading_zeros()).expect("at most 63");
    let top = exponent + 63 - leading_zeros;
    if top > 1023 {
        return f64::INFINITY;
    }
    let last_place = (top - 52).max(LEAST);
    let dropped = last_place - exponent;
    let kept = if dropped <= 0 {
        // At most 52 places: the mantissa has fewer than 53 bits here, and its top stays at or below bit 52.
        mantissa << dropped.unsigned_abs()
    } else if dropped > 64 {
        // Less than half of the last place.
        0
    } else {
        let kept = u64::try_from(u128::from(mantissa) >> dropped).expect("shifted by one at least");
        let rest = u128::from(mantissa) - (u128::from(kept) << dropped);
        let half = 1u128 << (dropped - 1);
        let up = rest > half || (rest == half && (inexact || kept % 2 == 1));
        kept + u64::from(up)
    };
    // A set bit 52 of `kept` adds 1 to the exponent field. A carry out of the mantissa does so too, up to infinity.
    let exponent_field = u64::from((last_place - LEAST).unsigned_abs());
    f64::from_bits((exponent_field << 52) + kept)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bits(mantissa: u64, inexact: bool, exponent: i32) -> u64 {
        round(false, mantissa, inexact, exponent).to_bits()
    }

    #[test]
    fn a_tie_goes_to_even_and_a_hair_above_it_goes_up() {
        let tie = (1 << 54) | 2;
        assert_eq!(bits(tie, false, -54), 1.0_f64.to_bits());
        assert_eq!(bits(tie, true, -54), 1.0_f64.to_bits() + 1);
        assert_eq!(bits((1 << 54) | 6, false, -54), 1.0_f64.to_bits() + 2);
    }

    #[test]
    fn denormals_are_rounded_once_at_their_own_last_place() {
        assert_eq!(bits(3, false, -1075), 2);
        assert_eq!(bits(1, false, -1075), 0);
        assert_eq!(bits(1 << 63, true, -1138), 1);
        assert_eq!(bits(1 << 63, false, -1138), 0);
        assert_eq!(bits(u64::MAX, true, -1139), 0);
        assert_eq!(bits(u64::MAX, true, -1138), 1);
        assert_eq!(bits((1 << 53) - 1, false, -1075), 1 << 52);
    }

    #[test]
    fn the_greatest_number_is_followed_by_infinity() {
        assert_eq!(bits((1 << 53) - 1, false, 971), f64::MAX.to_bits());
        assert_eq!(bits((1 << 54) - 1, false, 970), f64::INFINITY.to_bits());
        assert_eq!(bits(1, false, 1024), f64::INFINITY.to_bits());
    }

    #[test]
    fn underflow_keeps_its_sign() {
        assert_eq!(round(true, 1, false, -3000).to_bits(), (-0.0_f64).to_bits());
    }
}
