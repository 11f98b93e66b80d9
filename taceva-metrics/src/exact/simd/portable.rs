//! Two numbers per vector in plain Rust, for machines without a supported instruction set.

use crate::exact::vector::{Job, Vector};

/// Empty proof: every machine can run this code.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portable;

impl Portable {
    /// Runs `job` with pairs of numbers, which compilers map to the target's vectors.
    pub(in crate::exact) fn run<J: Job>(self, job: J) -> J::Output {
        job.run::<Pair>(self)
    }
}

#[derive(Clone, Copy)]
struct Pair([f64; 2]);

impl Pair {
    #[inline(always)]
    fn lanewise(self, other: Pair, operation: impl Fn(f64, f64) -> f64) -> Pair {
        let ([a, b], [c, d]) = (self.0, other.0);
        Pair([operation(a, c), operation(b, d)])
    }
}

/// Rounding error of a product without fused multiply-add: Veltkamp's splitting and Dekker's product (1971).
#[inline(always)]
fn error_of_product(left: f64, right: f64, product: f64) -> f64 {
    let ([left_high, left_low], [right_high, right_low]) = (split(left), split(right));
    let above = left_high * right_high - product;
    ((above + left_high * right_low) + left_low * right_high) + left_low * right_low
}

/// Splits a value into a number with the upper half of the mantissa and a number with the lower half. The sum of both is the value.
#[inline(always)]
fn split(value: f64) -> [f64; 2] {
    /// 2²⁷ + 1, which splits a mantissa in the middle.
    const SPLITTER: f64 = 134_217_729.0;
    let scaled = value * SPLITTER;
    let high = scaled - (scaled - value);
    [high, value - high]
}

impl Vector for Pair {
    type Proof = Portable;
    const LANES: usize = 2;

    #[inline(always)]
    fn splat(_proof: Portable, value: f64) -> Pair {
        Pair([value; 2])
    }

    #[inline(always)]
    fn load(_proof: Portable, values: &[f64]) -> Pair {
        Pair(values.try_into().expect("one number per lane"))
    }

    #[inline(always)]
    fn plus(self, other: Pair) -> Pair {
        self.lanewise(other, |a, b| a + b)
    }

    #[inline(always)]
    fn plus_aside(self, other: Pair, _one: Pair) -> Pair {
        self.plus(other)
    }

    #[inline(always)]
    fn prefetch(_values: &[f64]) {}

    #[inline(always)]
    fn minus(self, other: Pair) -> Pair {
        self.lanewise(other, |a, b| a - b)
    }

    #[inline(always)]
    fn times(self, other: Pair) -> Pair {
        self.lanewise(other, |a, b| a * b)
    }

    #[inline(always)]
    fn over(self, other: Pair) -> Pair {
        self.lanewise(other, |a, b| a / b)
    }

    #[inline(always)]
    fn magnitude(self) -> Pair {
        Pair(self.0.map(f64::abs))
    }

    #[inline(always)]
    fn product(self, other: Pair) -> [Pair; 2] {
        let rounded = self.times(other);
        let ([a, b], [c, d], [p, q]) = (self.0, other.0, rounded.0);
        let error = [error_of_product(a, c, p), error_of_product(b, d, q)];
        [rounded, Pair(error)]
    }

    #[inline(always)]
    fn greatest(self, other: Pair) -> Pair {
        self.lanewise(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn least(self, other: Pair) -> Pair {
        self.lanewise(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn predecessor(self) -> Pair {
        Pair(
            self.0
                .map(|value| f64::from_bits(value.to_bits().wrapping_sub(1))),
        )
    }

    #[inline(always)]
    fn all_at_most(self, bound: Pair) -> bool {
        self.0[0] <= bound.0[0] && self.0[1] <= bound.0[1]
    }

    #[inline(always)]
    fn keep_at_least(self, bound: Pair, value: Pair) -> Pair {
        let at_least = self.lanewise(bound, |a, b| f64::from(u8::from(a >= b)));
        at_least.lanewise(value, |kept, value| if kept > 0.0 { value } else { 0.0 })
    }

    #[inline(always)]
    fn count_at_least(self, bound: Pair) -> u32 {
        u32::from(self.0[0] >= bound.0[0]) + u32::from(self.0[1] >= bound.0[1])
    }

    #[inline(always)]
    fn units_above(self, start: Pair) -> i64 {
        let bits = |value: f64| value.to_bits().cast_signed();
        bits(self.0[0]) - bits(start.0[0]) + bits(self.0[1]) - bits(start.0[1])
    }

    #[inline(always)]
    fn sum_of_lanes(self) -> f64 {
        self.0[0] + self.0[1]
    }
}
