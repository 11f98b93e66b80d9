//! Vector operations for the inner loops of sums.

/// A vector of binary64 numbers.
///
/// Every operation rounds each lane to nearest, ties to even, so the width of the vector does not affect results.
pub(crate) trait Vector: Copy {
    /// Proof that the machine has the instructions, required to create a vector.
    type Proof: Copy;
    /// Number of lanes.
    const LANES: usize;

    /// `value` in every lane.
    fn splat(proof: Self::Proof, value: f64) -> Self;
    /// Loads one number per lane.
    ///
    /// # Panics
    /// If the number of `values` differs from [`LANES`](Vector::LANES).
    fn load(proof: Self::Proof, values: &[f64]) -> Self;

    /// self + other, rounded.
    fn plus(self, other: Self) -> Self;
    /// self + other, rounded. Where the adder is busier than the multiplier, the multiplier computes self + other × one.
    ///
    /// `one` is 1 in every lane. The compiler must not see this value, because it would replace the product by an addition.
    fn plus_aside(self, other: Self, one: Self) -> Self;
    /// self − other, rounded.
    fn minus(self, other: Self) -> Self;
    /// self × other, rounded.
    fn times(self, other: Self) -> Self;
    /// self / other, rounded.
    fn over(self, other: Self) -> Self;
    /// Absolute value of each lane.
    fn magnitude(self) -> Self;
    /// Rounded product self × other, and its rounding error, which is exact without over- and underflow.
    fn product(self, other: Self) -> [Self; 2];

    /// Lane-wise maximum; `other` if a number is NaN.
    fn greatest(self, other: Self) -> Self;
    /// Lane-wise minimum; `other` if a number is NaN.
    fn least(self, other: Self) -> Self;
    /// Bit pattern minus one: for a positive number the next smaller number, for a zero NaN.
    fn predecessor(self) -> Self;
    /// True if each lane is at most the same lane of `bound`; false if a number is NaN.
    fn all_at_most(self, bound: Self) -> bool;

    /// `value` in the lanes where self is at least `bound`, zero in the other lanes.
    fn keep_at_least(self, bound: Self, value: Self) -> Self;
    /// Number of lanes where self is at least `bound`.
    fn count_at_least(self, bound: Self) -> u32;

    /// Sum of the lanes' distances from `start`, in units of the last place of `start`. All numbers must have one exponent.
    fn units_above(self, start: Self) -> i64;

    /// Prefetches `values`, if the machine has a prefetch instruction.
    fn prefetch(values: &[f64]);
    /// The rounded sum of the lanes.
    #[cfg_attr(
        not(feature = "bench"),
        expect(dead_code, reason = "only the kernels of `bench` sum their lanes")
    )]
    fn sum_of_lanes(self) -> f64;

    /// Loads at most one number per lane and pads with zeros.
    #[inline(always)]
    fn load_short(proof: Self::Proof, values: &[f64]) -> Self {
        let mut lanes = [0.0; 8];
        lanes[..values.len()].copy_from_slice(values);
        Self::load(proof, &lanes[..Self::LANES])
    }
}

/// Computation that is generic over the vector width.
pub(crate) trait Job {
    /// Result of the computation.
    type Output;
    /// Runs the computation. Always inlined, so that it is compiled with the instructions of the vectors.
    fn run<V: Vector>(self, proof: V::Proof) -> Self::Output;
}
