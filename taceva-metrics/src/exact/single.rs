//! Conversion of binary64 numbers to exact numbers, for formulas with a single rounding at the end.

use std::cmp::Ordering;

use crate::exact::merge::Merge;
use crate::exact::{Dyadic, ExactSum};

/// Exact copy of a finite `value`.
pub(crate) fn exactly(value: f64) -> Dyadic {
    ExactSum::from_iter([value]).to_dyadic()
}

/// Sign of `value`, as its order against zero.
pub(crate) fn sign(value: &Dyadic) -> Ordering {
    match (value.is_zero(), value.to_f64().is_sign_negative()) {
        (true, _) => Ordering::Equal,
        (false, true) => Ordering::Less,
        (false, false) => Ordering::Greater,
    }
}

/// Absolute value of `value`.
pub(crate) fn magnitude(value: Dyadic) -> Dyadic {
    match sign(&value) {
        Ordering::Less => -value,
        _ => value,
    }
}

impl Merge for ExactSum {
    fn merge(&mut self, other: &ExactSum) {
        ExactSum::merge(self, other);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_too_small_for_binary64_keeps_its_sign() {
        let least = exactly(f64::from_bits(1));
        let product = &least * &-least.clone();
        assert_eq!(sign(&product), Ordering::Less);
        assert_eq!(sign(&magnitude(product)), Ordering::Greater);
        assert_eq!(sign(&exactly(-0.0)), Ordering::Equal);
    }
}
