//! Vector operations that an instruction set must provide.

#![expect(unsafe_code, reason = "loads and stores without bounds checks")]

/// A vector of binary32 values.
///
/// Every lane has the same operations in the same order. Results therefore do not depend on the width.
pub(crate) trait Vector: Copy {
    /// Proof that the CPU has the instructions, required to construct a vector.
    type Proof: Copy;
    /// Number of values per vector, a divisor of `PANEL`.
    const LANES: usize;
    /// Number of pixels in a tile of sums. The sums, a row of weights and one value must fit into registers.
    const ROWS: usize;
    /// Maximum number of panels of channels in a tile of sums.
    const PANELS: usize;

    /// Vector with zero in every lane.
    fn zero(proof: Self::Proof) -> Self;
    /// Vector with the value at `place` in every lane.
    ///
    /// # Safety
    /// `place` must point to a readable value.
    unsafe fn splat(proof: Self::Proof, place: *const f32) -> Self;
    /// Vector with `value` in every lane.
    #[inline(always)]
    fn constant(proof: Self::Proof, value: f32) -> Self {
        // SAFETY: `value` is a valid reference.
        unsafe { Self::splat(proof, &value) }
    }
    /// Loads `LANES` values, beginning at `place`.
    ///
    /// # Safety
    /// `LANES` values at `place` must be readable.
    unsafe fn load(proof: Self::Proof, place: *const f32) -> Self;
    /// Stores the lanes at `place`.
    ///
    /// # Safety
    /// `LANES` values at `place` must be writable.
    unsafe fn store(self, place: *mut f32);
    /// Prefetches the cache line of `place`, which may be any address. Affects only the run time.
    fn prefetch(_proof: Self::Proof, _place: *const f32) {}

    /// Computes self × factor + addend, rounded once if the instruction set has fused multiply-add.
    fn times_plus(self, factor: Self, addend: Self) -> Self;
    /// Computes self + other.
    fn plus(self, other: Self) -> Self;
    /// Replaces negative lanes by zero. NaN is preserved, so that a diverged training is detected.
    fn positive_part(self) -> Self;
}

/// A computation for vectors of every width.
pub(crate) trait Job {
    /// Result of the computation.
    type Output;
    /// Runs the computation. Implementations are always inlined, so that they are compiled for the instruction set of the vectors.
    fn run<V: Vector>(self, proof: V::Proof) -> Self::Output;
}
