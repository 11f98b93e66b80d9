//! Exact quotients, rounded only on conversion to binary64.

use super::rational::Dyadic;

/// Quotient of two exact numbers, with a positive denominator.
///
/// ```
/// use taceva_metrics::{Dyadic, Fraction};
/// let third = Fraction::of(Dyadic::from(1), 3);
/// assert_eq!(third.plus(&third).plus(&third).to_f64(), 1.0);
/// assert_eq!(third.minus(&Fraction::zero()).divided(3).root(), 1.0 / 3.0);
/// ```
#[derive(Clone, Debug)]
pub struct Fraction {
    above: Dyadic,
    below: Dyadic,
}

impl Fraction {
    /// The fraction `above` / `below`.
    ///
    /// # Panics
    /// If `below` is 0.
    pub fn of(above: Dyadic, below: u64) -> Fraction {
        assert!(below > 0, "a quotient needs a divisor");
        Fraction {
            above,
            below: Dyadic::from(below),
        }
    }

    /// The fraction 0.
    pub fn zero() -> Fraction {
        Fraction::of(Dyadic::from(0), 1)
    }

    /// self + `other`, exactly.
    pub fn plus(&self, other: &Fraction) -> Fraction {
        Fraction {
            above: &(&self.above * &other.below) + &(&other.above * &self.below),
            below: &self.below * &other.below,
        }
    }

    /// self − `other`, exactly.
    pub fn minus(&self, other: &Fraction) -> Fraction {
        Fraction {
            above: &(&self.above * &other.below) - &(&other.above * &self.below),
            below: &self.below * &other.below,
        }
    }

    /// self / `by`, exactly.
    ///
    /// # Panics
    /// If `by` is 0.
    pub fn divided(&self, by: u64) -> Fraction {
        assert!(by > 0, "a quotient needs a divisor");
        Fraction {
            above: self.above.clone(),
            below: &self.below * &Dyadic::from(by),
        }
    }

    /// True for a negative fraction.
    pub fn is_negative(&self) -> bool {
        self.above.is_negative()
    }

    /// True for zero.
    pub fn is_zero(&self) -> bool {
        self.above.is_zero()
    }

    /// The fraction, or zero if the fraction is negative.
    pub fn at_least_zero(&self) -> Fraction {
        match self.is_negative() {
            true => Fraction::zero(),
            false => self.clone(),
        }
    }

    /// Binary64 nearest to the fraction.
    pub fn to_f64(&self) -> f64 {
        self.above.over(&self.below)
    }

    /// √self, rounded once; 0 for a negative fraction.
    pub fn root(&self) -> f64 {
        self.above.root_over(&self.below)
    }

    /// self / other, rounded once; `None` if `other` is zero.
    pub fn over(&self, other: &Fraction) -> Option<f64> {
        Some(self.quotient(other)?.to_f64())
    }

    /// √(self / other), rounded once; `None` if `other` is zero.
    pub fn root_over(&self, other: &Fraction) -> Option<f64> {
        Some(self.quotient(other)?.root())
    }

    /// self / other, exactly; `None` if `other` is zero.
    fn quotient(&self, other: &Fraction) -> Option<Fraction> {
        (!other.is_zero()).then(|| Fraction {
            above: &self.above * &other.below,
            below: &self.below * &other.above,
        })
    }
}
