//! Two numbers per vector: NEON with fused multiply-add, which every 64-bit ARM processor has.

#![expect(unsafe_code, reason = "vector instructions and loads")]

use std::arch::aarch64::{
    float64x2_t, vabsq_f64, vaddq_f64, vaddvq_f64, vaddvq_s64, vaddvq_u64, vandq_u64, vbslq_f64,
    vcgeq_f64, vcgtq_f64, vcleq_f64, vcltq_f64, vdivq_f64, vdupq_n_f64, vdupq_n_u64, vfmaq_f64,
    vld1q_f64, vmulq_f64, vnegq_f64, vreinterpretq_f64_u64, vreinterpretq_s64_f64,
    vreinterpretq_u64_f64, vsubq_f64, vsubq_s64, vsubq_u64,
};

use crate::exact::vector::{Job, Vector};

/// Proof that the machine has NEON.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Neon(());

impl Neon {
    /// Proof for this processor; `None` if NEON is missing.
    pub(in crate::exact) fn detect() -> Option<Neon> {
        std::arch::is_aarch64_feature_detected!("neon").then_some(Neon(()))
    }

    /// Runs `job` with vectors of two numbers.
    pub(in crate::exact) fn run<J: Job>(self, job: J) -> J::Output {
        #[target_feature(enable = "neon")]
        fn with_instructions<J: Job>(proof: Neon, job: J) -> J::Output {
            job.run::<Two>(proof)
        }
        // SAFETY: only `detect` makes `self`, after it found the instructions.
        unsafe { with_instructions(self, job) }
    }
}

/// Vector of two numbers, created from the proof or from other vectors.
#[derive(Clone, Copy)]
struct Two(float64x2_t);

/// Runs one instruction. Its operands exist only on a machine with NEON.
macro_rules! with_neon {
    ($instruction:expr) => {
        // SAFETY: a `Two` or a `Neon` exists only on machines with NEON; no memory is accessed.
        unsafe { $instruction }
    };
}

impl Vector for Two {
    type Proof = Neon;
    const LANES: usize = 2;

    #[inline(always)]
    fn splat(_proof: Neon, value: f64) -> Two {
        Two(with_neon!(vdupq_n_f64(value)))
    }

    #[inline(always)]
    fn load(_proof: Neon, values: &[f64]) -> Two {
        assert_eq!(values.len(), Self::LANES, "one number per lane");
        // SAFETY: the machine has NEON, and the slice has two numbers.
        Two(unsafe { vld1q_f64(values.as_ptr()) })
    }

    #[inline(always)]
    fn plus(self, other: Two) -> Two {
        Two(with_neon!(vaddq_f64(self.0, other.0)))
    }

    #[inline(always)]
    fn plus_aside(self, other: Two, _one: Two) -> Two {
        self.plus(other)
    }

    #[inline(always)]
    fn prefetch(_values: &[f64]) {
        // The stable library has no prefetch instruction.
    }

    #[inline(always)]
    fn minus(self, other: Two) -> Two {
        Two(with_neon!(vsubq_f64(self.0, other.0)))
    }

    #[inline(always)]
    fn times(self, other: Two) -> Two {
        Two(with_neon!(vmulq_f64(self.0, other.0)))
    }

    #[inline(always)]
    fn over(self, other: Two) -> Two {
        Two(with_neon!(vdivq_f64(self.0, other.0)))
    }

    #[inline(always)]
    fn magnitude(self) -> Two {
        Two(with_neon!(vabsq_f64(self.0)))
    }

    #[inline(always)]
    fn product(self, other: Two) -> [Two; 2] {
        let rounded = self.times(other);
        let error = with_neon!(vfmaq_f64(vnegq_f64(rounded.0), self.0, other.0));
        [rounded, Two(error)]
    }

    #[inline(always)]
    fn greatest(self, other: Two) -> Two {
        // Not the machine's maximum, which returns NaN if one is NaN.
        let greater = with_neon!(vcgtq_f64(self.0, other.0));
        Two(with_neon!(vbslq_f64(greater, self.0, other.0)))
    }

    #[inline(always)]
    fn least(self, other: Two) -> Two {
        let less = with_neon!(vcltq_f64(self.0, other.0));
        Two(with_neon!(vbslq_f64(less, self.0, other.0)))
    }

    #[inline(always)]
    fn predecessor(self) -> Two {
        Two(with_neon!(vreinterpretq_f64_u64(vsubq_u64(
            vreinterpretq_u64_f64(self.0),
            vdupq_n_u64(1)
        ))))
    }

    #[inline(always)]
    fn all_at_most(self, bound: Two) -> bool {
        let ones = with_neon!(vandq_u64(vcleq_f64(self.0, bound.0), vdupq_n_u64(1)));
        with_neon!(vaddvq_u64(ones)) == 2
    }

    #[inline(always)]
    fn keep_at_least(self, bound: Two, value: Two) -> Two {
        Two(with_neon!(vreinterpretq_f64_u64(vandq_u64(
            vcgeq_f64(self.0, bound.0),
            vreinterpretq_u64_f64(value.0)
        ))))
    }

    #[inline(always)]
    fn count_at_least(self, bound: Two) -> u32 {
        let ones = with_neon!(vandq_u64(vcgeq_f64(self.0, bound.0), vdupq_n_u64(1)));
        u32::from(with_neon!(vaddvq_u64(ones)) != 0) + u32::from(with_neon!(vaddvq_u64(ones)) == 2)
    }

    #[inline(always)]
    fn units_above(self, start: Two) -> i64 {
        with_neon!(vaddvq_s64(vsubq_s64(
            vreinterpretq_s64_f64(self.0),
            vreinterpretq_s64_f64(start.0)
        )))
    }

    #[inline(always)]
    fn sum_of_lanes(self) -> f64 {
        with_neon!(vaddvq_f64(self.0))
    }
}
