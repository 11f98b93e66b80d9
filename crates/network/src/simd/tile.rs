//! The two innermost loops of convolutions, which take nearly all of the run time. Both loops compute tiles of sums in registers.

#![expect(unsafe_code, reason = "loads and stores without bounds checks")]

use super::vector::Vector;
use crate::panel::PANEL;

/// Sums of `ROWS` pixels (or rows of weights) by `VECTORS` vectors of channels.
#[derive(Clone, Copy)]
pub(crate) struct Tile<V: Vector, const ROWS: usize, const VECTORS: usize> {
    proof: V::Proof,
    sums: [[V; VECTORS]; ROWS],
}

/// Pixels of one picture in the order of summation, as offsets into two tensors.
///
/// Fields are private, because the unsafe loops in this file rely on the bounds computed by `new`.
#[derive(Clone, Debug)]
pub(crate) struct Pixels {
    offsets: Vec<(u32, u32)>,
    /// Largest offset into each tensor.
    reach: (usize, usize),
}

impl Pixels {
    /// Creates a list of the pixels at `offsets`.
    pub(crate) fn new(offsets: Vec<(u32, u32)>) -> Pixels {
        let reach = offsets.iter().fold((0, 0), |(a, b), &(from, to)| {
            (a.max(from as usize), b.max(to as usize))
        });
        Pixels { offsets, reach }
    }

    /// Number of pixels.
    pub(crate) fn len(&self) -> usize {
        self.offsets.len()
    }

    /// Offsets of the pixel `position` in the two tensors.
    #[inline(always)]
    pub(crate) fn at(&self, position: usize) -> (usize, usize) {
        let (from, to) = self.offsets[position];
        (from as usize, to as usize)
    }
}

/// Offset of the vector `vector` from the first vector, if panels are `stride` values apart.
#[inline(always)]
fn place<V: Vector>(vector: usize, stride: usize) -> usize {
    let lane = vector * V::LANES;
    lane / PANEL * stride + lane % PANEL
}

impl<V: Vector, const ROWS: usize, const VECTORS: usize> Tile<V, ROWS, VECTORS> {
    /// Creates a tile of zeros.
    #[inline(always)]
    pub(crate) fn zero(proof: V::Proof) -> Self {
        let sums = [[V::zero(proof); VECTORS]; ROWS];
        Tile { proof, sums }
    }

    /// Loads the values at `starts`. Panels are `stride` values apart.
    ///
    /// # Panics
    /// If a vector is outside `values`.
    #[inline(always)]
    pub(crate) fn load(
        proof: V::Proof,
        values: &[f32],
        starts: [usize; ROWS],
        stride: usize,
    ) -> Self {
        let mut tile = Self::zero(proof);
        for (row, start) in starts.into_iter().enumerate() {
            let values = &values[start..];
            assert!(
                place::<V>(VECTORS - 1, stride) + V::LANES <= values.len(),
                "a tile within the tensor"
            );
            for vector in 0..VECTORS {
                // SAFETY: the assertion above bounds the last vector, and offsets increase with the vector.
                tile.sums[row][vector] =
                    unsafe { V::load(proof, values.as_ptr().add(place::<V>(vector, stride))) };
            }
        }
        tile
    }

    /// Prefetches the values that [`load`](Tile::load) would read. Values outside `values` are skipped.
    #[inline(always)]
    pub(crate) fn prefetch(proof: V::Proof, values: &[f32], starts: [usize; ROWS], stride: usize) {
        for start in starts {
            for vector in (0..VECTORS).step_by((PANEL / V::LANES).max(1)) {
                if let Some(value) = values.get(start + place::<V>(vector, stride)) {
                    V::prefetch(proof, value);
                }
            }
        }
    }

    /// Stores the sums in `values` at `starts`. Panels are `stride` values apart.
    ///
    /// # Panics
    /// If a vector is outside `values`.
    #[inline(always)]
    pub(crate) fn store(self, values: &mut [f32], starts: [usize; ROWS], stride: usize) {
        for (row, start) in starts.into_iter().enumerate() {
            let values = &mut values[start..];
            assert!(
                place::<V>(VECTORS - 1, stride) + V::LANES <= values.len(),
                "a tile within the tensor"
            );
            for vector in 0..VECTORS {
                let to = values.as_mut_ptr();
                // SAFETY: the assertion above bounds the last vector, and offsets increase with the vector.
                unsafe { self.sums[row][vector].store(to.add(place::<V>(vector, stride))) };
            }
        }
    }

    /// Stores the sums of the row `row` in separate panels, at index `start` of each.
    ///
    /// # Panics
    /// If a panel is too short.
    #[inline(always)]
    pub(crate) fn store_row(&self, row: usize, panels: &mut [&mut [f32]], start: usize) {
        for vector in 0..VECTORS {
            let lane = vector * V::LANES;
            let values = &mut panels[lane / PANEL][start + lane % PANEL..];
            assert!(V::LANES <= values.len(), "a row within the panel");
            // SAFETY: the assertion above.
            unsafe { self.sums[row][vector].store(values.as_mut_ptr()) };
        }
    }

    /// Loads the sums of the row `row` from separate panels, at index `start` of each.
    ///
    /// # Panics
    /// If a panel is too short.
    #[inline(always)]
    pub(crate) fn load_row(&mut self, row: usize, panels: &[&mut [f32]], start: usize) {
        for vector in 0..VECTORS {
            let lane = vector * V::LANES;
            let values = &panels[lane / PANEL][start + lane % PANEL..];
            assert!(V::LANES <= values.len(), "a row within the panel");
            // SAFETY: the assertion above.
            self.sums[row][vector] = unsafe { V::load(self.proof, values.as_ptr()) };
        }
    }

    /// Adds the sums of `other` to the sums of this tile.
    #[inline(always)]
    pub(crate) fn plus(mut self, other: Self) -> Self {
        for (sums, others) in self.sums.iter_mut().zip(other.sums) {
            for (sum, other) in sums.iter_mut().zip(others) {
                *sum = sum.plus(other);
            }
        }
        self
    }

    /// Replaces negative sums by zero.
    #[inline(always)]
    pub(crate) fn positive_part(mut self) -> Self {
        for sum in self.sums.iter_mut().flatten() {
            *sum = sum.positive_part();
        }
        self
    }

    /// Adds to the sums of each pixel the products of `length` consecutive input values with `length` rows of `weights`. Panels of weights are
    /// `stride` values apart.
    ///
    /// # Panics
    /// If a run exceeds `input`, or the rows exceed `weights`.
    #[inline(always)]
    pub(crate) fn add_runs(
        &mut self,
        input: &[f32],
        starts: [usize; ROWS],
        weights: &[f32],
        stride: usize,
        length: usize,
    ) {
        let last = place::<V>(VECTORS - 1, stride) + V::LANES;
        assert!(
            length >= 1 && last + (length - 1) * PANEL <= weights.len(),
            "rows within the weights"
        );
        let runs: [*const f32; ROWS] = starts.map(|start| input[start..][..length].as_ptr());
        let weights = weights.as_ptr();
        let mut sums = self.sums;
        for step in 0..length {
            let row: [V; VECTORS] = std::array::from_fn(|vector| {
                let at = place::<V>(vector, stride) + step * PANEL;
                // SAFETY: the assertion above bounds the last vector of the last step, and offsets increase with both.
                unsafe { V::load(self.proof, weights.add(at)) }
            });
            for (sums, run) in sums.iter_mut().zip(runs) {
                // SAFETY: each run has `length` values, and `step` is less.
                let number = unsafe { V::splat(self.proof, run.add(step)) };
                for (sum, weight) in sums.iter_mut().zip(row) {
                    *sum = number.times_plus(weight, *sum);
                }
            }
        }
        self.sums = sums;
    }

    /// Adds to each row of sums one input value times the gradient channels, for each pixel. A pixel has `ROWS` input values.
    ///
    /// # Panics
    /// If a pixel is outside `input` or `gradient`.
    #[inline(always)]
    pub(crate) fn add_pixels(&mut self, pixels: &Pixels, input: &[f32], gradient: &[f32]) {
        assert!(
            pixels.reach.0 + ROWS <= input.len(),
            "pixels within the input"
        );
        assert!(
            pixels.reach.1 + VECTORS * V::LANES <= gradient.len(),
            "pixels within the gradient"
        );
        let mut sums = self.sums;
        for &(from, to) in &pixels.offsets {
            // SAFETY: no offset exceeds `reach`, which the assertions above bound.
            let (numbers, channels) = unsafe {
                (
                    input.as_ptr().add(from as usize),
                    gradient.as_ptr().add(to as usize),
                )
            };
            let row: [V; VECTORS] = std::array::from_fn(|vector| {
                // SAFETY: `VECTORS` vectors are within the gradient at each pixel.
                unsafe { V::load(self.proof, channels.add(vector * V::LANES)) }
            });
            for (place, sums) in sums.iter_mut().enumerate() {
                // SAFETY: `ROWS` values are within the input at each pixel.
                let number = unsafe { V::splat(self.proof, numbers.add(place)) };
                for (sum, channel) in sums.iter_mut().zip(row) {
                    *sum = number.times_plus(channel, *sum);
                }
            }
        }
        self.sums = sums;
    }
}
