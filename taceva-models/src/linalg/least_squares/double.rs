//! Double-double numbers with about 32 digits.

use std::ops::{Add, Mul, Sub};

/// Sum of high and low, with |low| at most half a unit in the last place of high.
#[derive(Clone, Copy, Debug)]
pub(super) struct Double {
    high: f64,
    low: f64,
}

/// Exact sum of a and b: the rounded sum and its rounding error (Knuth).
fn two_sum(a: f64, b: f64) -> Double {
    let sum = a + b;
    let of_b = sum - a;
    let low = (a - (sum - of_b)) + (b - of_b);
    Double { high: sum, low }
}

impl Double {
    /// Creates the number high + low.
    pub(super) fn new(high: f64, low: f64) -> Double {
        two_sum(high, low)
    }

    /// Exact product of a and b: the rounded product and its rounding error, by a fused multiply-add.
    pub(super) fn product(a: f64, b: f64) -> Double {
        let high = a * b;
        Double {
            high,
            low: a.mul_add(b, -high),
        }
    }

    /// Rounds the number to double precision.
    pub(super) fn value(&self) -> f64 {
        self.high + self.low
    }
}

impl Add for Double {
    type Output = Double;

    fn add(self, other: Double) -> Double {
        let high = two_sum(self.high, other.high);
        let low = two_sum(self.low, other.low);
        let first = two_sum(high.high, high.low + low.high);
        two_sum(first.high, first.low + low.low)
    }
}

impl Sub for Double {
    type Output = Double;

    fn sub(self, other: Double) -> Double {
        self + Double {
            high: -other.high,
            low: -other.low,
        }
    }
}

impl Mul for Double {
    type Output = Double;

    fn mul(self, other: Double) -> Double {
        let product = Double::product(self.high, other.high);
        let crossed = self.high * other.low + self.low * other.high;
        two_sum(product.high, product.low + crossed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_one_double_loses_two_keep() {
        let tiny = 2_f64.powi(-80);
        let sum = Double::new(1.0, 0.0) + Double::new(tiny, 0.0) - Double::new(1.0, 0.0);
        assert_eq!(sum.value().to_bits(), tiny.to_bits());
        let third = Double::new(1.0 / 3.0, 0.0);
        let rest = Double::new(1.0, 0.0) - third * Double::new(3.0, 0.0);
        // 1/3 is rounded down by a third of 2⁻⁵⁴.
        assert_eq!(rest.value().to_bits(), 2_f64.powi(-54).to_bits());
    }
}
