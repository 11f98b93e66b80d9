//! Numbers with a finite binary expansion, and their quotients, rounded once.

use std::ops::{Add, Mul, Neg, Sub};

use super::canonical::Canonical;
use super::digits::UNIT_EXPONENT;
use super::integer::Natural;
use super::rounding::round;
use super::sum::ExactSum;

/// Exact product of an integer and a power of two.
///
/// Sums, differences and products are exact. [`over`](Dyadic::over) and [`root_over`](Dyadic::root_over) round once.
///
/// ```
/// use taceva_metrics::Dyadic;
/// let tenth = Dyadic::from_f64(0.1);
/// let square = &tenth * &tenth;
/// assert_eq!((&square - &square).to_f64(), 0.0);
/// assert_eq!(square.root_over(&Dyadic::from(1)), 0.1);
/// assert_eq!(Dyadic::from(2).over(&Dyadic::from(3)), 2.0 / 3.0);
/// ```
#[derive(Clone, Debug)]
pub struct Dyadic {
    negative: bool,
    magnitude: Natural,
    exponent: i32,
}

impl Dyadic {
    pub(super) fn from_canonical(canonical: &Canonical) -> Dyadic {
        let limb = |pair: &[u32]| {
            u64::from(pair[0]) | u64::from(pair.get(1).copied().unwrap_or_default()) << 32
        };
        let first = i32::try_from(canonical.first()).expect("a digit's index is below 140");
        Dyadic {
            negative: canonical.is_negative(),
            magnitude: Natural::from_limbs(canonical.digits().chunks(2).map(limb).collect()),
            exponent: 32 * first + UNIT_EXPONENT,
        }
    }

    /// Exact value of a finite binary64.
    ///
    /// # Panics
    /// If `value` is NaN or infinite.
    pub fn from_f64(value: f64) -> Dyadic {
        std::iter::once(value).collect::<ExactSum>().to_dyadic()
    }

    /// True for a negative number.
    pub fn is_negative(&self) -> bool {
        self.negative && !self.is_zero()
    }

    /// True for zero.
    pub fn is_zero(&self) -> bool {
        self.magnitude.is_zero()
    }

    /// Nearest binary64, ties to even.
    pub fn to_f64(&self) -> f64 {
        self.over(&Dyadic::from(1))
    }

    /// Binary64 nearest to `self / divisor`, ties to even: a single rounding, even for denormal results.
    ///
    /// # Panics
    /// If `divisor` is zero.
    pub fn over(&self, divisor: &Dyadic) -> f64 {
        assert!(!divisor.is_zero(), "a quotient needs a divisor");
        if self.is_zero() {
            return 0.0;
        }
        let (leading, inexact, power) = self.magnitude.leading_quotient(&divisor.magnitude);
        let power = i32::try_from(power).expect("sums have fewer than 2^31 bits");
        let exponent = self.exponent - divisor.exponent + power;
        round(
            self.negative != divisor.negative,
            leading,
            inexact,
            exponent,
        )
    }

    /// Binary64 nearest to √(self / divisor), rounded once, even if the quotient is out of range; 0 for a negative quotient.
    ///
    /// The code computes at least 64 bits of the root in integers. These bits and a flag for the remainder determine the rounding.
    ///
    /// # Panics
    /// If `divisor` is zero.
    pub fn root_over(&self, divisor: &Dyadic) -> f64 {
        assert!(!divisor.is_zero(), "a quotient needs a divisor");
        if self.is_zero() || self.negative != divisor.negative {
            return 0.0;
        }
        // The quotient to about 128 bits and a flag for a remainder, then its root to about 62 bits.
        let bits =
            |natural: &Natural| i64::try_from(natural.bits()).expect("bits that fit in memory");
        let up = (128 - (bits(&self.magnitude) - bits(&divisor.magnitude))).max(0);
        let exponent = i64::from(self.exponent) - i64::from(divisor.exponent);
        // The root of an even power of two is exact.
        let up = up + (exponent - up).rem_euclid(2);
        let places = usize::try_from(up).expect("not below 0");
        let (quotient, is_exact) = self
            .magnitude
            .shifted_up(places)
            .divided_by(&divisor.magnitude);
        let (root, is_square) = quotient.root();
        let half = i32::try_from((exponent - up) / 2).expect("sums have fewer than 2^31 bits");
        let (leading, lost, power) = root.leading_bits();
        round(
            false,
            leading,
            lost || !is_square || !is_exact,
            half + power,
        )
    }

    /// Magnitude in units of 2^`exponent`. The argument must not exceed the exponent of the number.
    fn magnitude_at(&self, exponent: i32) -> Natural {
        let places = usize::try_from(self.exponent - exponent).expect("the lower exponent of two");
        self.magnitude.shifted_up(places)
    }
}

impl From<u64> for Dyadic {
    fn from(value: u64) -> Dyadic {
        Dyadic {
            negative: false,
            magnitude: Natural::from(value),
            exponent: 0,
        }
    }
}

impl Neg for Dyadic {
    type Output = Dyadic;
    fn neg(self) -> Dyadic {
        Dyadic {
            negative: !self.negative,
            ..self
        }
    }
}

impl Add for &Dyadic {
    type Output = Dyadic;
    fn add(self, other: &Dyadic) -> Dyadic {
        if self.is_zero() {
            return other.clone();
        }
        if other.is_zero() {
            return self.clone();
        }
        let exponent = self.exponent.min(other.exponent);
        let (left, right) = (self.magnitude_at(exponent), other.magnitude_at(exponent));
        let (negative, magnitude) = if self.negative == other.negative {
            (self.negative, left.plus(&right))
        } else if left >= right {
            (self.negative, left.minus(&right))
        } else {
            (other.negative, right.minus(&left))
        };
        Dyadic {
            negative,
            magnitude,
            exponent,
        }
    }
}

impl Sub for &Dyadic {
    type Output = Dyadic;
    fn sub(self, other: &Dyadic) -> Dyadic {
        self + &-other.clone()
    }
}

impl Mul for &Dyadic {
    type Output = Dyadic;
    fn mul(self, other: &Dyadic) -> Dyadic {
        Dyadic {
            negative: self.negative != other.negative,
            magnitude: self.magnitude.times(&other.magnitude),
            exponent: self.exponent + other.exponent,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn exact(value: f64) -> Dyadic {
        Dyadic::from_f64(value)
    }

    #[test]
    fn a_quotient_of_two_binary64_is_the_machine_s_own() {
        let values = [
            1.0,
            -3.0,
            0.1,
            1e-300,
            -7e299,
            f64::MIN_POSITIVE,
            f64::from_bits(1),
            f64::from_bits(0xf_ffff_ffff_fff1),
            f64::MAX,
        ];
        for left in values {
            for right in values {
                let quotient = exact(left).over(&exact(right));
                assert_eq!(
                    quotient.to_bits(),
                    (left / right).to_bits(),
                    "{left:e} / {right:e}"
                );
                let sum = (&exact(left) + &exact(right)).to_f64();
                assert_eq!(
                    sum.to_bits(),
                    (left + right).to_bits(),
                    "{left:e} + {right:e}"
                );
                let product = (&exact(left) * &exact(right)).to_f64();
                assert_eq!(
                    product.to_bits(),
                    (left * right).to_bits(),
                    "{left:e} × {right:e}"
                );
            }
        }
    }

    #[test]
    fn a_root_is_the_nearest_number_and_keeps_its_digits_at_both_ends_of_the_range() {
        for value in [
            2.0,
            3.0,
            0.1,
            1e300,
            1e-300,
            4.0,
            2.25,
            f64::MAX,
            f64::from_bits(1),
        ] {
            let root = exact(value).root_over(&Dyadic::from(1));
            assert_eq!(root.to_bits(), value.sqrt().to_bits(), "{value:e}");
            // The root of a squared value is the value, even if the square exceeds the range of binary64.
            let square = &exact(value) * &exact(value);
            assert_eq!(
                square.root_over(&Dyadic::from(1)).to_bits(),
                value.to_bits()
            );
        }
        // √(1/3) has no finite expansion: both neighbours enclose it.
        let root = Dyadic::from(1).root_over(&Dyadic::from(3));
        let (below, above) = (root.next_down(), root.next_up());
        let third = |of: f64| &(&exact(of) * &exact(of)) * &Dyadic::from(3);
        assert!((&third(below) - &Dyadic::from(1)).is_negative());
        assert!(!(&third(above) - &Dyadic::from(1)).is_negative());
        assert_eq!(Dyadic::from(0).root_over(&Dyadic::from(3)).to_bits(), 0);
    }

    #[test]
    fn a_difference_of_equals_is_zero() {
        let difference = &exact(0.1) - &exact(0.1);
        assert!(difference.is_zero());
        assert_eq!(difference.to_f64().to_bits(), 0.0_f64.to_bits());
    }
}
