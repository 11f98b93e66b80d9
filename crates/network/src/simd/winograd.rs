//! Vectors that lie apart, as the transforms of Winograd's convolutions read and write them: a row or column of a tile, or what lies at
//! several points.

#![expect(unsafe_code, reason = "loads and stores without bounds checks")]

use super::vector::Vector;

/// Where vectors lie: the first at `start`, `stride` numbers from one to the next, `count` of them; what lies beyond is not touched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Spaced {
    pub(crate) start: usize,
    pub(crate) stride: usize,
    pub(crate) count: usize,
}

impl Spaced {
    /// The vectors of `values`; zero in place of those beyond the count.
    ///
    /// # Panics
    /// If one lies outside `values`.
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
                // SAFETY: the assertion above bounds the last vector, and places rise with the vector.
                *vector = unsafe { V::load(proof, values.as_ptr().add(at * self.stride)) };
            }
        } else {
            for (at, vector) in vectors.iter_mut().enumerate() {
                if at < count {
                    // SAFETY: the assertion above bounds the last vector, and places rise with the vector.
                    *vector = unsafe { V::load(proof, values.as_ptr().add(at * self.stride)) };
                }
            }
        }
        vectors
    }

    /// Writes as many of `vectors` as the count says to `values`.
    ///
    /// # Panics
    /// If one lies outside `values`.
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
                // SAFETY: the assertion above bounds the last vector, and places rise with the vector.
                unsafe { vector.store(values.as_mut_ptr().add(at * self.stride)) };
            }
        }
    }

    /// Numbers that `count` vectors reach over.
    #[inline(always)]
    fn reach<V: Vector>(self, count: usize) -> usize {
        let last = (count - 1).saturating_mul(self.stride);
        last.saturating_add(V::LANES)
    }
}
