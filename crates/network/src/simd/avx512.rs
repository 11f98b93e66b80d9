//! AVX-512: sixteen f32 values per vector.

#![expect(unsafe_code, reason = "vector instructions, loads and stores")]

use std::arch::x86_64::{
    __m512, _MM_HINT_T0, _mm_prefetch, _mm512_add_ps, _mm512_fmadd_ps, _mm512_loadu_ps,
    _mm512_max_ps, _mm512_set1_ps, _mm512_setzero_ps, _mm512_storeu_ps,
};

use super::vector::{Job, Vector};

/// Proof that the CPU has AVX-512.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx512(());

impl Avx512 {
    /// Returns the proof; `None` if the CPU lacks the instructions.
    pub(crate) fn detect() -> Option<Avx512> {
        (is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("fma"))
            .then_some(Avx512(()))
    }

    /// Runs `job` with these vectors.
    pub(crate) fn run<J: Job>(self, job: J) -> J::Output {
        #[target_feature(enable = "avx512f,fma")]
        fn with_instructions<J: Job>(proof: Avx512, job: J) -> J::Output {
            job.run::<Sixteen>(proof)
        }
        // SAFETY: only `detect` makes `self`, after it found the instructions.
        unsafe { with_instructions(self, job) }
    }
}

/// Sixteen f32 values. Construction requires a proof or other vectors.
#[derive(Clone, Copy)]
struct Sixteen(__m512);

/// Executes one instruction on values whose existence proves that the CPU has this instruction.
macro_rules! proven {
    ($instruction:expr) => {
        // SAFETY: a vector or proof exists only on CPUs with AVX-512; no memory is accessed.
        unsafe { $instruction }
    };
}

impl Vector for Sixteen {
    type Proof = Avx512;
    const LANES: usize = 16;
    const ROWS: usize = 6;
    const PANELS: usize = 4;

    #[inline(always)]
    fn zero(_proof: Avx512) -> Sixteen {
        Sixteen(proven!(_mm512_setzero_ps()))
    }

    #[inline(always)]
    unsafe fn splat(_proof: Avx512, place: *const f32) -> Sixteen {
        // SAFETY: the CPU has the instruction, and the caller guarantees a number at `place`.
        Sixteen(unsafe { _mm512_set1_ps(*place) })
    }

    #[inline(always)]
    unsafe fn load(_proof: Avx512, place: *const f32) -> Sixteen {
        // SAFETY: the CPU has the instruction, and the caller guarantees one number per lane at `place`.
        Sixteen(unsafe { _mm512_loadu_ps(place) })
    }

    #[inline(always)]
    unsafe fn store(self, place: *mut f32) {
        // SAFETY: the CPU has the instruction, and the caller guarantees space for one number per lane at `place`.
        unsafe { _mm512_storeu_ps(place, self.0) }
    }

    #[inline(always)]
    fn prefetch(_proof: Avx512, place: *const f32) {
        proven!(_mm_prefetch::<_MM_HINT_T0>(place.cast()));
    }

    #[inline(always)]
    fn times_plus(self, factor: Sixteen, addend: Sixteen) -> Sixteen {
        Sixteen(proven!(_mm512_fmadd_ps(self.0, factor.0, addend.0)))
    }

    #[inline(always)]
    fn plus(self, other: Sixteen) -> Sixteen {
        Sixteen(proven!(_mm512_add_ps(self.0, other.0)))
    }

    #[inline(always)]
    fn positive_part(self) -> Sixteen {
        // If either operand is NaN, the instruction returns the second one.
        Sixteen(proven!(_mm512_max_ps(_mm512_setzero_ps(), self.0)))
    }
}
