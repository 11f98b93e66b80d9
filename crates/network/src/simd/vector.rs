//! What the loops of this crate ask of a machine's vectors.

#![expect(unsafe_code, reason = "loads and stores without bounds checks")]

/// Some binary32 numbers that are worked on together.
///
/// Lane by lane the same operations in the same order, so that the width changes no result.
pub(crate) trait Vector: Copy {
    /// Evidence that the machine has the instructions; without it there is no vector.
    type Proof: Copy;
    /// How many numbers: a divisor of a panel.
    const LANES: usize;
    /// How many pixels a tile of sums has, so that the sums, a row of weights and one number fit the registers.
    const ROWS: usize;
    /// How many panels of channels a tile of sums has at most.
    const PANELS: usize;

    /// Zero in every lane.
    fn zero(proof: Self::Proof) -> Self;
    /// The number at `place` in every lane.
    ///
    /// # Safety
    /// A number lies at `place`.
    unsafe fn splat(proof: Self::Proof, place: *const f32) -> Self;
    /// `value` in every lane.
    #[inline(always)]
    fn constant(proof: Self::Proof, value: f32) -> Self {
        // SAFETY: `value` is a number that lies somewhere.
        unsafe { Self::splat(proof, &value) }
    }
    /// The numbers from `place` on.
    ///
    /// # Safety
    /// As many numbers as there are lanes lie at `place`.
    unsafe fn load(proof: Self::Proof, place: *const f32) -> Self;
    /// Writes the lanes to `place`.
    ///
    /// # Safety
    /// As many numbers as there are lanes may be written at `place`.
    unsafe fn store(self, place: *mut f32);
    /// Asks for the cache line of `place`, which is needed soon and may be anywhere; changes nothing but time.
    fn prefetch(_proof: Self::Proof, _place: *const f32) {}

    /// self × factor + addend, rounded once where the machine can.
    fn times_plus(self, factor: Self, addend: Self) -> Self;
    /// self + other.
    fn plus(self, other: Self) -> Self;
    /// Zero in the lanes below zero; NaN stays, so that it is found.
    fn positive_part(self) -> Self;
}

/// Work written once for vectors of every width.
pub(crate) trait Job {
    /// What comes of it.
    type Output;
    /// Does it; always inlined, so that it is compiled with the instructions of the vectors.
    fn run<V: Vector>(self, proof: V::Proof) -> Self::Output;
}
