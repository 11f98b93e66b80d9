//! Vectors of four f32 values in plain Rust, for CPUs without a supported instruction set.

#![expect(unsafe_code, reason = "loads and stores without bounds checks")]

use super::vector::{Job, Vector};

/// Proof for the portable vectors, which every CPU can run.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Portable;

impl Portable {
    /// Runs `job` with vectors of four values, which the compiler maps to the target's vectors.
    pub(crate) fn run<J: Job>(self, job: J) -> J::Output {
        job.run::<Four>(self)
    }
}

/// Four f32 values.
#[derive(Clone, Copy)]
struct Four([f32; 4]);

impl Vector for Four {
    type Proof = Portable;
    const LANES: usize = 4;
    // Targets have at least sixteen registers of four values.
    const ROWS: usize = 2;
    const PANELS: usize = 1;

    #[inline(always)]
    fn zero(_proof: Portable) -> Four {
        Four([0.0; 4])
    }

    #[inline(always)]
    unsafe fn splat(_proof: Portable, place: *const f32) -> Four {
        // SAFETY: the caller guarantees a number at `place`.
        Four([unsafe { place.read() }; 4])
    }

    #[inline(always)]
    unsafe fn load(_proof: Portable, place: *const f32) -> Four {
        // SAFETY: the caller guarantees four numbers at `place`; an array of f32 has the alignment of one.
        Four(unsafe { place.cast::<[f32; 4]>().read() })
    }

    #[inline(always)]
    unsafe fn store(self, place: *mut f32) {
        // SAFETY: the caller guarantees space for four numbers at `place`; an array of f32 has the alignment of one.
        unsafe { place.cast::<[f32; 4]>().write(self.0) }
    }

    #[inline(always)]
    fn times_plus(self, factor: Four, addend: Four) -> Four {
        // Not `mul_add`: without the instruction it is a library call, a hundred times slower.
        Four(std::array::from_fn(|lane| {
            self.0[lane] * factor.0[lane] + addend.0[lane]
        }))
    }

    #[inline(always)]
    fn plus(self, other: Four) -> Four {
        Four(std::array::from_fn(|lane| self.0[lane] + other.0[lane]))
    }

    #[inline(always)]
    fn positive_part(self) -> Four {
        Four(self.0.map(|value| if value < 0.0 { 0.0 } else { value }))
    }
}
