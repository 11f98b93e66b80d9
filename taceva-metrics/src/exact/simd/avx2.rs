//! Four numbers per vector: AVX2 with fused multiply-add.

#![expect(unsafe_code, reason = "vector instructions and loads")]

use std::arch::x86_64::{
    __m256d, _CMP_GE_OQ, _CMP_LE_OQ, _MM_HINT_T1, _mm_add_epi64, _mm_add_pd, _mm_cvtsd_f64,
    _mm_cvtsi128_si64, _mm_prefetch, _mm_unpackhi_epi64, _mm_unpackhi_pd, _mm256_add_pd,
    _mm256_and_pd, _mm256_andnot_pd, _mm256_castpd_si256, _mm256_castpd256_pd128,
    _mm256_castsi256_pd, _mm256_castsi256_si128, _mm256_cmp_pd, _mm256_div_pd,
    _mm256_extractf128_pd, _mm256_extracti128_si256, _mm256_fmsub_pd, _mm256_loadu_pd,
    _mm256_max_pd, _mm256_min_pd, _mm256_movemask_pd, _mm256_mul_pd, _mm256_set1_epi64x,
    _mm256_set1_pd, _mm256_sub_epi64, _mm256_sub_pd,
};

use crate::exact::vector::{Job, Vector};

/// Proof that the machine has AVX2, FMA and POPCNT.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx2(());

impl Avx2 {
    /// Proof for this processor; `None` if AVX2, FMA or POPCNT is missing.
    pub(in crate::exact) fn detect() -> Option<Avx2> {
        let found = is_x86_feature_detected!("avx2")
            && is_x86_feature_detected!("fma")
            && is_x86_feature_detected!("popcnt");
        found.then_some(Avx2(()))
    }

    /// Runs `job` with vectors of four numbers.
    pub(in crate::exact) fn run<J: Job>(self, job: J) -> J::Output {
        #[target_feature(enable = "avx2,fma,popcnt")]
        fn with_instructions<J: Job>(proof: Avx2, job: J) -> J::Output {
            job.run::<Four>(proof)
        }
        // SAFETY: only `detect` makes `self`, after it found the instructions.
        unsafe { with_instructions(self, job) }
    }
}

/// Vector of four numbers, created from the proof or from other vectors.
#[derive(Clone, Copy)]
struct Four(__m256d);

/// Runs one instruction. Its operands exist only on a machine with AVX2.
macro_rules! with_avx2 {
    ($instruction:expr) => {
        // SAFETY: a `Four` or an `Avx2` exists only on machines with AVX2 and FMA; no memory is accessed.
        unsafe { $instruction }
    };
}

impl Four {
    /// Mask of the lanes with values of at least `bound`, one bit per lane.
    #[inline(always)]
    fn lanes_at_least(self, bound: Four) -> i32 {
        with_avx2!(_mm256_movemask_pd(_mm256_cmp_pd::<_CMP_GE_OQ>(
            self.0, bound.0
        )))
    }
}

impl Vector for Four {
    type Proof = Avx2;
    const LANES: usize = 4;

    #[inline(always)]
    fn splat(_proof: Avx2, value: f64) -> Four {
        Four(with_avx2!(_mm256_set1_pd(value)))
    }

    #[inline(always)]
    fn load(_proof: Avx2, values: &[f64]) -> Four {
        assert_eq!(values.len(), Self::LANES, "one number per lane");
        // SAFETY: the machine has AVX2, and the slice has four numbers.
        Four(unsafe { _mm256_loadu_pd(values.as_ptr()) })
    }

    #[inline(always)]
    fn plus(self, other: Four) -> Four {
        Four(with_avx2!(_mm256_add_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn plus_aside(self, other: Four, _one: Four) -> Four {
        // No register is free for the vector of ones, and loading the vector for each sum costs more than the multiplier saves.
        self.plus(other)
    }

    #[inline(always)]
    fn prefetch(values: &[f64]) {
        // SAFETY: a prefetch of any address is harmless.
        unsafe { _mm_prefetch::<_MM_HINT_T1>(values.as_ptr().cast()) }
    }

    #[inline(always)]
    fn minus(self, other: Four) -> Four {
        Four(with_avx2!(_mm256_sub_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn times(self, other: Four) -> Four {
        Four(with_avx2!(_mm256_mul_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn over(self, other: Four) -> Four {
        Four(with_avx2!(_mm256_div_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn magnitude(self) -> Four {
        Four(with_avx2!(_mm256_andnot_pd(_mm256_set1_pd(-0.0), self.0)))
    }

    #[inline(always)]
    fn product(self, other: Four) -> [Four; 2] {
        let rounded = self.times(other);
        let error = with_avx2!(_mm256_fmsub_pd(self.0, other.0, rounded.0));
        [rounded, Four(error)]
    }

    #[inline(always)]
    fn greatest(self, other: Four) -> Four {
        Four(with_avx2!(_mm256_max_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn least(self, other: Four) -> Four {
        Four(with_avx2!(_mm256_min_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn predecessor(self) -> Four {
        Four(with_avx2!(_mm256_castsi256_pd(_mm256_sub_epi64(
            _mm256_castpd_si256(self.0),
            _mm256_set1_epi64x(1)
        ))))
    }

    #[inline(always)]
    fn all_at_most(self, bound: Four) -> bool {
        with_avx2!(_mm256_movemask_pd(_mm256_cmp_pd::<_CMP_LE_OQ>(
            self.0, bound.0
        ))) == 0b1111
    }

    #[inline(always)]
    fn keep_at_least(self, bound: Four, value: Four) -> Four {
        Four(with_avx2!(_mm256_and_pd(
            _mm256_cmp_pd::<_CMP_GE_OQ>(self.0, bound.0),
            value.0
        )))
    }

    #[inline(always)]
    fn count_at_least(self, bound: Four) -> u32 {
        self.lanes_at_least(bound).count_ones()
    }

    #[inline(always)]
    fn units_above(self, start: Four) -> i64 {
        let units = with_avx2!(_mm256_sub_epi64(
            _mm256_castpd_si256(self.0),
            _mm256_castpd_si256(start.0)
        ));
        let pair = with_avx2!(_mm_add_epi64(
            _mm256_castsi256_si128(units),
            _mm256_extracti128_si256::<1>(units)
        ));
        with_avx2!(_mm_cvtsi128_si64(_mm_add_epi64(
            pair,
            _mm_unpackhi_epi64(pair, pair)
        )))
    }

    #[inline(always)]
    fn sum_of_lanes(self) -> f64 {
        let pair = with_avx2!(_mm_add_pd(
            _mm256_castpd256_pd128(self.0),
            _mm256_extractf128_pd::<1>(self.0)
        ));
        with_avx2!(_mm_cvtsd_f64(_mm_add_pd(pair, _mm_unpackhi_pd(pair, pair))))
    }
}
