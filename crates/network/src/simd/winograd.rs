//! Strided vectors for Winograd's transforms: a row or column of a tile, or values at several points.

#![expect(unsafe_code, reason = "loads and stores without bounds checks")]

use super::vector::Vector;

/// Positions of `count` vectors. The first vector is at `start`, and vectors are `stride` values apart. Vectors beyond `count` are not accessed.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spaced {
    pub(crate) start: usize,
    pub(crate) stride: usize,
    pub(crate) count: usize,
}

impl Spaced {
    /// Loads the vectors from `values`. Vectors beyond the count are zero.
    ///
    /// # Panics
    /// If a vector is outside `values`.
    #[inline(always)]
    pub(crate) fn load<V: Vector, const N: usize>(self, proof: V::Proof, values: &[f32]) -> [V; N] {
        let count = self.count.min(N);
        let mut vectors = [V::zero(proof); N];
        if count == 0 {
            return vectors;
        }
        let values = &values[self.start..];
        assert!(
            self.reach::<V>(count) <= values.len(),
            "vectors within the tensor"
        );
        if count == N {
            for (at, vector) in vectors.iter_mut().enumerate() {
                // SAFETY: the assertion above bounds the last vector, and offsets increase with the vector.
                *vector = unsafe { V::load(proof, values.as_ptr().add(at * self.stride)) };
            }
        } else {
            for (at, vector) in vectors.iter_mut().enumerate() {
                if at < count {
                    // SAFETY: the assertion above bounds the last vector, and offsets increase with the vector.
                    *vector = unsafe { V::load(proof, values.as_ptr().add(at * self.stride)) };
                }
            }
        }
        vectors
    }

    /// Stores the first `count` vectors of `vectors` in `values`.
    ///
    /// # Panics
    /// If a vector is outside `values`.
    #[inline(always)]
    pub(crate) fn store<V: Vector, const N: usize>(self, vectors: [V; N], values: &mut [f32]) {
        let count = self.count.min(N);
        if count == 0 {
            return;
        }
        let values = &mut values[self.start..];
        assert!(
            self.reach::<V>(count) <= values.len(),
            "vectors within the tensor"
        );
        for (at, vector) in vectors.into_iter().enumerate() {
            if at < count {
                // SAFETY: the assertion above bounds the last vector, and offsets increase with the vector.
                unsafe { vector.store(values.as_mut_ptr().add(at * self.stride)) };
            }
        }
    }

    /// Length of the range that `count` vectors span, in values.
    #[inline(always)]
    fn reach<V: Vector>(self, count: usize) -> usize {
        let last = (count - 1).saturating_mul(self.stride);
        last.saturating_add(V::LANES)
    }
}
