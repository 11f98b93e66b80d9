//! What the block kernel asks of a machine's vectors.

/// Some binary64 numbers that are worked on together.
///
/// Every operation rounds to nearest, ties to even, lane by lane, so that the width changes no result.
pub(crate) trait Vector: Copy {
    /// Evidence that the machine has the instructions; without it there is no vector.
    type Proof: Copy;
    /// How many numbers.
    const LANES: usize;

    /// `value` in every lane.
    fn splat(proof: Self::Proof, value: f64) -> Self;
    /// As many numbers as there are lanes.
    ///
    /// # Panics
    /// If `values` are more or fewer.
    fn load(proof: Self::Proof, values: &[f64]) -> Self;

    /// RN(self + other).
    fn plus(self, other: Self) -> Self;
    /// RN(self + other) by whichever unit is less busy: the multiplier forms self + other × one.
    ///
    /// `one` is one in every lane, which the compiler must not know of, lest it turned this into an addition again.
    fn plus_aside(self, other: Self, one: Self) -> Self;
    /// RN(self − other).
    fn minus(self, other: Self) -> Self;
    /// RN(self × other).
    fn times(self, other: Self) -> Self;
    /// RN(self / other).
    fn over(self, other: Self) -> Self;
    /// |self|.
    fn magnitude(self) -> Self;
    /// RN(self × other), and what that differs from the product by, exactly, where neither over- nor underflows.
    fn product(self, other: Self) -> [Self; 2];

    /// The greater of the two, and `other` where one is NaN.
    fn greatest(self, other: Self) -> Self;
    /// The lesser of the two, and `other` where one is NaN.
    fn least(self, other: Self) -> Self;
    /// The pattern of bits one below: the next smaller number of a positive one, NaN of a zero.
    fn predecessor(self) -> Self;
    /// Whether each lane is at most that of `bound`; false if one is NaN.
    fn all_at_most(self, bound: Self) -> bool;

    /// `value` in the lanes where `self` is at least `bound`, zero in the others.
    fn keep_at_least(self, bound: Self, value: Self) -> Self;
    /// In how many lanes `self` is at least `bound`.
    fn count_at_least(self, bound: Self) -> u32;

    /// The lanes' distances from `start` in units of its last place, summed; all are in one binade.
    fn units_above(self, start: Self) -> i64;

    /// Asks for the memory of `values` ahead of its use, where the machine has an instruction for that.
    fn prefetch(values: &[f64]);
    /// The rounded sum of the lanes.
    #[cfg_attr(
        not(feature = "bench"),
        expect(dead_code, reason = "only the kernels of `bench` sum their lanes")
    )]
    fn sum_of_lanes(self) -> f64;

    /// Fewer numbers than there are lanes, and zeros.
    #[inline(always)]
    fn load_short(proof: Self::Proof, values: &[f64]) -> Self {
        let mut lanes = [0.0; 8];
        lanes[..values.len()].copy_from_slice(values);
        Self::load(proof, &lanes[..Self::LANES])
    }
}

/// Work written once for vectors of every width.
pub(crate) trait Job {
    /// What comes of it.
    type Output;
    /// Does it; always inlined, so that it is compiled with the instructions of the vectors.
    fn run<V: Vector>(self, proof: V::Proof) -> Self::Output;
}
