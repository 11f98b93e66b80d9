#![expect(
    unsafe_code,
    reason = "vectors and arrays of four numbers are reinterpreted as the same bytes"
)]
//! Four numbers in one register.
//!
//! The compiler alone would keep the four numbers of a texel in separate registers. Every operation follows IEEE 754 on each lane, so that vector and array
//! implementations give the same bits. Every x86-64 has SSE2.

#[cfg(target_arch = "x86_64")]
use std::arch::x86_64 as isa;

/// Four binary32 numbers in one vector register.
#[derive(Clone, Copy, Debug)]
pub(in crate::optics) struct Lanes(Vector);

#[cfg(target_arch = "x86_64")]
type Vector = isa::__m128;
#[cfg(not(target_arch = "x86_64"))]
type Vector = [f32; 4];

#[cfg(target_arch = "x86_64")]
impl Lanes {
    #[inline(always)]
    pub(in crate::optics) fn new([a, b, c, d]: [f32; 4]) -> Lanes {
        // SAFETY: every x86-64 has SSE2.
        Lanes(unsafe { isa::_mm_setr_ps(a, b, c, d) })
    }

    #[inline(always)]
    pub(in crate::optics) fn to_array(self) -> [f32; 4] {
        // SAFETY: both are sixteen bytes, and any bytes are four numbers.
        unsafe { std::mem::transmute::<isa::__m128, [f32; 4]>(self.0) }
    }

    #[inline(always)]
    pub(in crate::optics) fn plus(self, other: Lanes) -> Lanes {
        // SAFETY: every x86-64 has SSE2.
        Lanes(unsafe { isa::_mm_add_ps(self.0, other.0) })
    }

    #[inline(always)]
    pub(in crate::optics) fn minus(self, other: Lanes) -> Lanes {
        // SAFETY: every x86-64 has SSE2.
        Lanes(unsafe { isa::_mm_sub_ps(self.0, other.0) })
    }

    #[inline(always)]
    pub(in crate::optics) fn times(self, other: Lanes) -> Lanes {
        // SAFETY: every x86-64 has SSE2.
        Lanes(unsafe { isa::_mm_mul_ps(self.0, other.0) })
    }

    #[inline(always)]
    pub(in crate::optics) fn root(self) -> Lanes {
        // SAFETY: every x86-64 has SSE2.
        Lanes(unsafe { isa::_mm_sqrt_ps(self.0) })
    }

    /// Joins the low `BITS` bits of each lane with the bits of `high`, which become the higher bits.
    #[inline(always)]
    pub(in crate::optics) fn joined_with<const BITS: i32>(self, high: Lanes) -> [u32; 4] {
        // SAFETY: every x86-64 has SSE2.
        let mask = unsafe { isa::_mm_set1_epi32((1 << BITS) - 1) };
        let low_bits = |lanes: Lanes| {
            // SAFETY: every x86-64 has SSE2.
            let bits = unsafe { isa::_mm_castps_si128(lanes.0) };
            // SAFETY: every x86-64 has SSE2.
            unsafe { isa::_mm_and_si128(bits, mask) }
        };
        // SAFETY: every x86-64 has SSE2.
        let above = unsafe { isa::_mm_slli_epi32::<BITS>(low_bits(high)) };
        // SAFETY: every x86-64 has SSE2.
        let joined = unsafe { isa::_mm_or_si128(above, low_bits(self)) };
        // SAFETY: both are sixteen bytes, and any bytes are four whole numbers.
        unsafe { std::mem::transmute::<isa::__m128i, [u32; 4]>(joined) }
    }
}

#[cfg(not(target_arch = "x86_64"))]
impl Lanes {
    #[inline(always)]
    pub(in crate::optics) fn new(numbers: [f32; 4]) -> Lanes {
        Lanes(numbers)
    }

    #[inline(always)]
    pub(in crate::optics) fn to_array(self) -> [f32; 4] {
        self.0
    }

    #[inline(always)]
    pub(in crate::optics) fn plus(self, other: Lanes) -> Lanes {
        Lanes(std::array::from_fn(|lane| self.0[lane] + other.0[lane]))
    }

    #[inline(always)]
    pub(in crate::optics) fn minus(self, other: Lanes) -> Lanes {
        Lanes(std::array::from_fn(|lane| self.0[lane] - other.0[lane]))
    }

    #[inline(always)]
    pub(in crate::optics) fn times(self, other: Lanes) -> Lanes {
        Lanes(std::array::from_fn(|lane| self.0[lane] * other.0[lane]))
    }

    #[inline(always)]
    pub(in crate::optics) fn root(self) -> Lanes {
        Lanes(self.0.map(f32::sqrt))
    }

    /// Joins the low `BITS` bits of each lane with the bits of `high`, which become the higher bits.
    #[inline(always)]
    pub(in crate::optics) fn joined_with<const BITS: i32>(self, high: Lanes) -> [u32; 4] {
        let low_bits = |number: f32| number.to_bits() & ((1 << BITS) - 1);
        std::array::from_fn(|lane| low_bits(high.0[lane]) << BITS | low_bits(self.0[lane]))
    }
}

impl Lanes {
    /// Puts the same number in each lane.
    #[inline(always)]
    pub(in crate::optics) fn splat(number: f32) -> Lanes {
        Lanes::new([number; 4])
    }

    /// Interpolates from `self` towards `other` by the fraction `part`.
    #[inline(always)]
    pub(in crate::optics) fn towards(self, other: Lanes, part: Lanes) -> Lanes {
        self.plus(part.times(other.minus(self)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lanes_reckon_as_numbers_do_to_the_bit() {
        let [a, b] = [[1.5e-3_f32, -7.1, 0.3, 2e20], [3.3_f32, 0.7, -1e-9, 5.5]];
        let [left, right] = [a, b].map(Lanes::new);
        let expect = |found: Lanes, expected: fn(f32, f32) -> f32| {
            let expected: [f32; 4] = std::array::from_fn(|lane| expected(a[lane], b[lane]));
            assert_eq!(
                found.to_array().map(f32::to_bits),
                expected.map(f32::to_bits)
            );
        };
        expect(left.plus(right), |a, b| a + b);
        expect(left.minus(right), |a, b| a - b);
        expect(left.times(right), |a, b| a * b);
        expect(left.times(left).root(), |a, _| (a * a).sqrt());
        expect(left.towards(right, Lanes::splat(0.25)), |a, b| {
            a + 0.25 * (b - a)
        });
        let bits = |number: f32| number.to_bits() & 0xff;
        let joined: [u32; 4] = std::array::from_fn(|lane| bits(b[lane]) << 8 | bits(a[lane]));
        assert_eq!(left.joined_with::<8>(right), joined);
    }
}
