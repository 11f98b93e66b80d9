//! Eight numbers per vector: AVX-512.

#![expect(unsafe_code, reason = "vector instructions and loads")]

use std::arch::x86_64::{
    __m512d, _CMP_GE_OQ, _CMP_LE_OQ, _MM_HINT_T1, _mm_prefetch, _mm512_abs_pd, _mm512_add_pd,
    _mm512_castpd_si512, _mm512_castsi512_pd, _mm512_cmp_pd_mask, _mm512_div_pd, _mm512_fmadd_pd,
    _mm512_fmsub_pd, _mm512_loadu_pd, _mm512_maskz_mov_pd, _mm512_max_pd, _mm512_min_pd,
    _mm512_mul_pd, _mm512_reduce_add_epi64, _mm512_reduce_add_pd, _mm512_set1_epi64,
    _mm512_set1_pd, _mm512_sub_epi64, _mm512_sub_pd,
};

use crate::exact::vector::{Job, Vector};

/// Proof that the machine has AVX-512F and POPCNT.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Avx512(());

impl Avx512 {
    /// Proof for this processor; `None` if AVX-512F or POPCNT is missing.
    pub(in crate::exact) fn detect() -> Option<Avx512> {
        let found = is_x86_feature_detected!("avx512f") && is_x86_feature_detected!("popcnt");
        found.then_some(Avx512(()))
    }

    /// Runs `job` with vectors of eight numbers.
    pub(in crate::exact) fn run<J: Job>(self, job: J) -> J::Output {
        #[target_feature(enable = "avx512f,popcnt")]
        fn with_instructions<J: Job>(proof: Avx512, job: J) -> J::Output {
            job.run::<Eight>(proof)
        }
        // SAFETY: only `detect` makes `self`, after it found the instructions.
        unsafe { with_instructions(self, job) }
    }
}

/// Vector of eight numbers, created from the proof or from other vectors.
#[derive(Clone, Copy)]
struct Eight(__m512d);

/// Runs one instruction. Its operands exist only on a machine with AVX-512F.
macro_rules! with_avx512 {
    ($instruction:expr) => {
        // SAFETY: an `Eight` or an `Avx512` exists only on machines with AVX-512F; no memory is accessed.
        unsafe { $instruction }
    };
}

impl Vector for Eight {
    type Proof = Avx512;
    const LANES: usize = 8;

    #[inline(always)]
    fn splat(_proof: Avx512, value: f64) -> Eight {
        Eight(with_avx512!(_mm512_set1_pd(value)))
    }

    #[inline(always)]
    fn load(_proof: Avx512, values: &[f64]) -> Eight {
        assert_eq!(values.len(), Self::LANES, "one number per lane");
        // SAFETY: the machine has AVX-512F, and the slice has eight numbers.
        Eight(unsafe { _mm512_loadu_pd(values.as_ptr()) })
    }

    #[inline(always)]
    fn plus(self, other: Eight) -> Eight {
        Eight(with_avx512!(_mm512_add_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn plus_aside(self, other: Eight, one: Eight) -> Eight {
        Eight(with_avx512!(_mm512_fmadd_pd(other.0, one.0, self.0)))
    }

    #[inline(always)]
    fn prefetch(values: &[f64]) {
        // SAFETY: a prefetch of any address is harmless.
        unsafe { _mm_prefetch::<_MM_HINT_T1>(values.as_ptr().cast()) }
    }

    #[inline(always)]
    fn minus(self, other: Eight) -> Eight {
        Eight(with_avx512!(_mm512_sub_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn times(self, other: Eight) -> Eight {
        Eight(with_avx512!(_mm512_mul_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn over(self, other: Eight) -> Eight {
        Eight(with_avx512!(_mm512_div_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn magnitude(self) -> Eight {
        Eight(with_avx512!(_mm512_abs_pd(self.0)))
    }

    #[inline(always)]
    fn product(self, other: Eight) -> [Eight; 2] {
        let rounded = self.times(other);
        let error = with_avx512!(_mm512_fmsub_pd(self.0, other.0, rounded.0));
        [rounded, Eight(error)]
    }

    #[inline(always)]
    fn greatest(self, other: Eight) -> Eight {
        Eight(with_avx512!(_mm512_max_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn least(self, other: Eight) -> Eight {
        Eight(with_avx512!(_mm512_min_pd(self.0, other.0)))
    }

    #[inline(always)]
    fn predecessor(self) -> Eight {
        Eight(with_avx512!(_mm512_castsi512_pd(_mm512_sub_epi64(
            _mm512_castpd_si512(self.0),
            _mm512_set1_epi64(1)
        ))))
    }

    #[inline(always)]
    fn all_at_most(self, bound: Eight) -> bool {
        with_avx512!(_mm512_cmp_pd_mask::<_CMP_LE_OQ>(self.0, bound.0)) == u8::MAX
    }

    #[inline(always)]
    fn keep_at_least(self, bound: Eight, value: Eight) -> Eight {
        Eight(with_avx512!(_mm512_maskz_mov_pd(
            _mm512_cmp_pd_mask::<_CMP_GE_OQ>(self.0, bound.0),
            value.0
        )))
    }

    #[inline(always)]
    fn count_at_least(self, bound: Eight) -> u32 {
        with_avx512!(_mm512_cmp_pd_mask::<_CMP_GE_OQ>(self.0, bound.0)).count_ones()
    }

    #[inline(always)]
    fn units_above(self, start: Eight) -> i64 {
        with_avx512!(_mm512_reduce_add_epi64(_mm512_sub_epi64(
            _mm512_castpd_si512(self.0),
            _mm512_castpd_si512(start.0)
        )))
    }

    #[inline(always)]
    fn sum_of_lanes(self) -> f64 {
        with_avx512!(_mm512_reduce_add_pd(self.0))
    }
}
