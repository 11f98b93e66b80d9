//! Exact sum of a limited number of values of moderate magnitude, in sixteen bytes.

use super::digits::Binary;
use super::sum::ExactSum;

/// Exponent of two of the unit, the last place of 2⁻⁴⁴.
const UNIT: i32 = -96;
/// Position of a mantissa whose lowest bit is the unit 2⁻⁹⁶. Position 0 is that of the least denormal.
const LEAST_POSITION: usize = 1074 - 96;
/// Number of positions from `LEAST_POSITION` on, which limits numbers to magnitudes below 2¹⁴.
const POSITIONS: usize = 58;

/// Sum in whole units of 2⁻⁹⁶, before the units move to an [`ExactSum`].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct FixedSum {
    units: i128,
}

impl FixedSum {
    /// Greatest number of additions before `settle_into`: 2¹⁶ values below 2¹¹⁰ units fit an `i128`.
    pub(crate) const MOST: usize = 1 << 16;

    /// Adds `value` and returns true. Returns false and adds nothing for a magnitude of 2¹⁴ or more, or a nonzero magnitude below 2⁻⁴⁴.
    #[inline]
    pub(crate) fn try_add(&mut self, value: f64) -> bool {
        let Binary {
            sign,
            mantissa,
            position,
        } = Binary::of(value);
        let places = position.wrapping_sub(LEAST_POSITION);
        if places >= POSITIONS {
            return mantissa == 0;
        }
        let units = i128::from(mantissa) << places;
        self.units += if sign < 0 { -units } else { units };
        true
    }

    /// Moves the units to `sum`.
    pub(crate) fn settle_into(&mut self, sum: &mut ExactSum) {
        let units = std::mem::take(&mut self.units);
        let low = |places: u32| i64::try_from((units >> places) & 0xffff_ffff).expect("32 bits");
        let high = i64::try_from(units >> 64).expect("64 bits are left of 128");
        for (part, unit) in [(low(0), UNIT), (low(32), UNIT + 32), (high, UNIT + 64)] {
            sum.add_units(part, unit);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sum of `values`, and the number of values outside the range of [`FixedSum`], which are added one by one.
    fn summed(values: &[f64]) -> (ExactSum, usize) {
        let (mut fixed, mut sum, mut strays) = (FixedSum::default(), ExactSum::default(), 0);
        for &value in values {
            if !fixed.try_add(value) {
                sum.add(value);
                strays += 1;
            }
        }
        fixed.settle_into(&mut sum);
        fixed.settle_into(&mut sum);
        (sum, strays)
    }

    #[test]
    fn a_fixed_sum_is_exact_and_says_what_it_does_not_hold() {
        let two = |power: i32| 2.0_f64.powi(power);
        let held = [
            0.1,
            -0.3,
            0.0,
            -0.0,
            5.5,
            two(-44),
            -two(-44),
            two(14) - two(-39),
            1e-13,
        ];
        let strays = [
            two(14),
            -two(14),
            two(-45),
            1e300,
            f64::from_bits(1),
            -1e-300,
        ];
        let both: Vec<f64> = held.iter().chain(&strays).copied().collect();
        for (values, expected) in [(&held[..], 0), (&strays[..], 6), (&both[..], 6)] {
            let (sum, strays) = summed(values);
            assert_eq!((sum, strays), (values.iter().copied().collect(), expected));
        }
    }

    #[test]
    fn as_many_as_are_allowed_of_the_greatest_do_not_overflow() {
        let greatest = f64::from_bits(2.0_f64.powi(14).to_bits() - 1);
        for value in [greatest, -greatest] {
            let values = vec![value; FixedSum::MOST];
            let (sum, strays) = summed(&values);
            assert_eq!((sum, strays), (values.into_iter().collect(), 0));
        }
    }
}
