//! Exact quotients, each rounded once where it leaves.

use super::rational::Dyadic;

/// A quotient of two exact numbers, the lower one above 0.
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
    /// `above` over `below`.
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

    /// 0.
    pub fn zero() -> Fraction {
        Fraction::of(Dyadic::from(0), 1)
    }

    /// The exact sum.
    pub fn plus(&self, other: &Fraction) -> Fraction {
        Fraction {
            above: &(&self.above * &other.below) + &(&other.above * &self.below),
            below: &self.below * &other.below,
        }
    }

    /// The exact difference.
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

    /// True below zero.
    pub fn is_negative(&self) -> bool {
        self.above.is_negative()
    }

    /// True at zero.
    pub fn is_zero(&self) -> bool {
        self.above.is_zero()
    }

    /// The fraction, or zero in the place of a negative one.
    pub fn at_least_zero(&self) -> Fraction {
        match self.is_negative() {
            true => Fraction::zero(),
            false => self.clone(),
        }
    }

    /// The nearest binary64.
    pub fn to_f64(&self) -> f64 {
        self.above.over(&self.below)
    }

    /// √self, rounded once; 0 for a negative one.
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
