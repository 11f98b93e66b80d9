//! Exact quotients, each rounded once where it leaves.

use taceva_metrics::Dyadic;

/// A quotient of two exact numbers, the lower one above 0.
#[derive(Clone, Debug)]
pub(crate) struct Fraction {
    above: Dyadic,
    below: Dyadic,
}

impl Fraction {
    pub(crate) fn of(above: Dyadic, below: u64) -> Fraction {
        assert!(below > 0, "a quotient needs a divisor");
        Fraction {
            above,
            below: Dyadic::from(below),
        }
    }

    pub(crate) fn zero() -> Fraction {
        Fraction::of(Dyadic::from(0), 1)
    }

    pub(crate) fn plus(&self, other: &Fraction) -> Fraction {
        Fraction {
            above: &(&self.above * &other.below) + &(&other.above * &self.below),
            below: &self.below * &other.below,
        }
    }

    pub(crate) fn minus(&self, other: &Fraction) -> Fraction {
        Fraction {
            above: &(&self.above * &other.below) - &(&other.above * &self.below),
            below: &self.below * &other.below,
        }
    }

    pub(crate) fn divided(&self, by: u64) -> Fraction {
        assert!(by > 0, "a quotient needs a divisor");
        Fraction {
            above: self.above.clone(),
            below: &self.below * &Dyadic::from(by),
        }
    }

    pub(crate) fn is_negative(&self) -> bool {
        self.above.is_negative()
    }

    pub(crate) fn is_zero(&self) -> bool {
        self.above.is_zero()
    }

    /// The fraction, or zero in the place of a negative one.
    pub(crate) fn at_least_zero(&self) -> Fraction {
        match self.is_negative() {
            true => Fraction::zero(),
            false => self.clone(),
        }
    }

    pub(crate) fn to_f64(&self) -> f64 {
        self.above.over(&self.below)
    }

    /// √self, rounded once; 0 for a negative one.
    pub(crate) fn root(&self) -> f64 {
        self.above.root_over(&self.below)
    }

    /// self / other, rounded once; `None` if `other` is zero.
    pub(crate) fn over(&self, other: &Fraction) -> Option<f64> {
        (!other.is_zero()).then(|| {
            let (above, below) = (&self.above * &other.below, &self.below * &other.above);
            above.over(&below)
        })
    }

    /// √(self / other), rounded once; `None` if `other` is zero.
    pub(crate) fn root_over(&self, other: &Fraction) -> Option<f64> {
        (!other.is_zero()).then(|| {
            let (above, below) = (&self.above * &other.below, &self.below * &other.above);
            above.root_over(&below)
        })
    }
}
