//! NEON: four f32 values per vector.

#![expect(unsafe_code, reason = "vector instructions, loads and stores")]

use std::arch::aarch64::{
    float32x4_t, vaddq_f32, vdupq_n_f32, vfmaq_f32, vld1q_dup_f32, vld1q_f32, vmaxq_f32, vst1q_f32,
};

use super::vector::{Job, Vector};

/// Proof that the CPU has NEON.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neon(());

impl Neon {
    /// Returns the proof; `None` if the CPU lacks the instructions.
    pub(crate) fn detect() -> Option<Neon> {
        (std::arch::is_aarch64_feature_detected!("neon")).then_some(Neon(()))
    }

    /// Runs `job` with these vectors.
    pub(crate) fn run<J: Job>(self, job: J) -> J::Output {
        #[target_feature(enable = "neon")]
        fn with_instructions<J: Job>(proof: Neon, job: J) -> J::Output {
            job.run::<Four>(proof)
        }
        // SAFETY: only `detect` makes `self`, after it found the instructions.
        unsafe { with_instructions(self, job) }
    }
}

/// Four f32 values. Construction requires a proof or other vectors.
#[derive(Clone, Copy)]
struct Four(float32x4_t);

/// Executes one instruction on values whose existence proves that the CPU has this instruction.
macro_rules! proven {
    ($instruction:expr) => {
        // SAFETY: a vector or proof exists only on CPUs with NEON; no memory is accessed.
        unsafe { $instruction }
    };
}

impl Vector for Four {
    type Proof = Neon;
    const LANES: usize = 4;
    const ROWS: usize = 6;
    const PANELS: usize = 1;

    #[inline(always)]
    fn zero(_proof: Neon) -> Four {
        Four(proven!(vdupq_n_f32(0.0)))
    }

    #[inline(always)]
    unsafe fn splat(_proof: Neon, place: *const f32) -> Four {
        // SAFETY: the CPU has the instruction, and the caller guarantees a number at `place`.
        Four(unsafe { vld1q_dup_f32(place) })
    }

    #[inline(always)]
    unsafe fn load(_proof: Neon, place: *const f32) -> Four {
        // SAFETY: the CPU has the instruction, and the caller guarantees one number per lane at `place`.
        Four(unsafe { vld1q_f32(place) })
    }

    #[inline(always)]
    unsafe fn store(self, place: *mut f32) {
        // SAFETY: the CPU has the instruction, and the caller guarantees space for one number per lane at `place`.
        unsafe { vst1q_f32(place, self.0) }
    }

    #[inline(always)]
    fn times_plus(self, factor: Four, addend: Four) -> Four {
        Four(proven!(vfmaq_f32(addend.0, self.0, factor.0)))
    }

    #[inline(always)]
    fn plus(self, other: Four) -> Four {
        Four(proven!(vaddq_f32(self.0, other.0)))
    }

    #[inline(always)]
    fn positive_part(self) -> Four {
        Four(proven!(vmaxq_f32(self.0, vdupq_n_f32(0.0))))
    }
}
