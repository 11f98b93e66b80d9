//! AVX2 with fused multiply-add: eight f32 values per vector.

#![expect(unsafe_code, reason = "vector instructions, loads and stores")]

use std::arch::x86_64::{
    __m256, _MM_HINT_T0, _mm_prefetch, _mm256_add_ps, _mm256_broadcast_ss, _mm256_fmadd_ps,
    _mm256_loadu_ps, _mm256_max_ps, _mm256_setzero_ps, _mm256_storeu_ps,
};

use super::vector::{Job, Vector};

/// Proof that the CPU has AVX2 with fused multiply-add.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx2(());

impl Avx2 {
    /// Returns the proof; `None` if the CPU lacks the instructions.
    pub(crate) fn detect() -> Option<Avx2> {
        (is_x86_feature_detected!("avx2") && is_x86_feature_detected!("fma")).then_some(Avx2(()))
    }

    /// Runs `job` with these vectors.
    pub(crate) fn run<J: Job>(self, job: J) -> J::Output {
        #[target_feature(enable = "avx2,fma")]
        fn with_instructions<J: Job>(proof: Avx2, job: J) -> J::Output {
            job.run::<Eight>(proof)
        }
        // SAFETY: only `detect` makes `self`, after it found the instructions.
        unsafe { with_instructions(self, job) }
    }
}

/// Eight f32 values. Construction requires a proof or other vectors.
#[derive(Clone, Copy)]
struct Eight(__m256);

/// Executes one instruction on values whose existence proves that the CPU has this instruction.
macro_rules! proven {
    ($instruction:expr) => {
        // SAFETY: a vector or proof exists only on CPUs with AVX2 and fused multiply-add; no memory is accessed.
        unsafe { $instruction }
    };
}

impl Vector for Eight {
    type Proof = Avx2;
    const LANES: usize = 8;
    const ROWS: usize = 6;
    const PANELS: usize = 1;

    #[inline(always)]
    fn zero(_proof: Avx2) -> Eight {
        Eight(proven!(_mm256_setzero_ps()))
    }

    #[inline(always)]
    unsafe fn splat(_proof: Avx2, place: *const f32) -> Eight {
        // SAFETY: the CPU has the instruction, and the caller guarantees a number at `place`.
        Eight(unsafe { _mm256_broadcast_ss(&*place) })
    }

    #[inline(always)]
    unsafe fn load(_proof: Avx2, place: *const f32) -> Eight {
        // SAFETY: the CPU has the instruction, and the caller guarantees one number per lane at `place`.
        Eight(unsafe { _mm256_loadu_ps(place) })
    }

    #[inline(always)]
    unsafe fn store(self, place: *mut f32) {
        // SAFETY: the CPU has the instruction, and the caller guarantees space for one number per lane at `place`.
        unsafe { _mm256_storeu_ps(place, self.0) }
    }

    #[inline(always)]
    fn prefetch(_proof: Avx2, place: *const f32) {
        proven!(_mm_prefetch::<_MM_HINT_T0>(place.cast()));
    }

    #[inline(always)]
    fn times_plus(self, factor: Eight, addend: Eight) -> Eight {
        Eight(proven!(_mm256_fmadd_ps(self.0, factor.0, addend.0)))
    }

    #[inline(always)]
    fn plus(self, other: Eight) -> Eight {
        Eight(proven!(_mm256_add_ps(self.0, other.0)))
    }

    #[inline(always)]
    fn positive_part(self) -> Eight {
        // If either operand is NaN, the instruction returns the second one.
        Eight(proven!(_mm256_max_ps(_mm256_setzero_ps(), self.0)))
    }
}
