//! Vector operations required of an instruction set.

#![expect(unsafe_code, reason = "loads and stores without bounds checks")]

/// A vector of binary32 values.
///
/// Every lane has the same operations in the same order, so the width does not affect results.
pub(crate) trait Vector: Copy {
    /// Proof that the CPU has the instructions. No vector can be constructed without it.
    type Proof: Copy;
    /// Values per vector: a divisor of a panel.
    const LANES: usize;
    /// Pixels in a tile of sums. The sums, a row of weights and one value must fit into registers.
    const ROWS: usize;
    /// Most panels of channels in a tile of sums.
    const PANELS: usize;

    /// Zero in every lane.
    fn zero(proof: Self::Proof) -> Self;
    /// The value at `place` in every lane.
    ///
    /// # Safety
    /// `place` must point to a readable value.
    unsafe fn splat(proof: Self::Proof, place: *const f32) -> Self;
    /// `value` in every lane.
    #[inline(always)]
    fn constant(proof: Self::Proof, value: f32) -> Self {
        // SAFETY: `value` is a valid reference.
        unsafe { Self::splat(proof, &value) }
    }
    /// Loads the values from `place` on.
    ///
    /// # Safety
    /// `LANES` values at `place` must be readable.
    unsafe fn load(proof: Self::Proof, place: *const f32) -> Self;
    /// Stores the lanes at `place`.
    ///
    /// # Safety
    /// `LANES` values at `place` must be writable.
    unsafe fn store(self, place: *mut f32);
    /// Prefetches the cache line of `place`, which may be any address. Affects only the time.
    fn prefetch(_proof: Self::Proof, _place: *const f32) {}

    /// self × factor + addend, rounded once if the instruction set has fused multiply-add.
    fn times_plus(self, factor: Self, addend: Self) -> Self;
    /// self + other.
    fn plus(self, other: Self) -> Self;
    /// Replaces negative lanes by zero. Keeps NaN, so that a diverged training is detected.
    fn positive_part(self) -> Self;
}

/// A computation for vectors of every width.
pub(crate) trait Job {
    /// Result of the computation.
    type Output;
    /// Runs the computation. Implementations are always inlined, so they are compiled for the instruction set of the vectors.
    fn run<V: Vector>(self, proof: V::Proof) -> Self::Output;
}
