//! Digits of an exact sum: conversion of numbers and products to digits, and propagation of carries.

/// Number of 32-bit digits for the full range of sums. The range begins below the square of the least denormal and ends above 2⁶⁴ squares of the
/// greatest number.
pub(super) const DIGITS: usize = 140;
/// Exponent of two of the lowest bit of the lowest digit.
pub(super) const UNIT_EXPONENT: i32 = -2176;

/// A finite binary64 as `sign × mantissa × 2^(position − 1074)`.
pub(super) struct Binary {
    pub(super) sign: i64,
    pub(super) mantissa: u64,
    pub(super) position: usize,
}

impl Binary {
    #[inline]
    pub(super) fn of(value: f64) -> Binary {
        const FRACTION: u64 = (1 << 52) - 1;
        let bits = value.to_bits();
        let exponent = (bits >> 52) & 0x7ff;
        let implicit = u64::from(exponent != 0) << 52;
        Binary {
            sign: 1 - 2 * i64::from(value.is_sign_negative()),
            mantissa: (bits & FRACTION) | implicit,
            position: exponent.saturating_sub(1) as usize,
        }
    }
}

/// Four digits of `product × 2^(position mod 32)`, lowest first. A product of two mantissas has at most 106 bits.
#[inline]
pub(super) fn split(product: u128, position: usize) -> [i64; 4] {
    let shift = position % 32;
    let low = (product & u128::from(u64::MAX)) << shift;
    let high = (product >> 64) << shift;
    [
        low_digit(low),
        low_digit(low >> 32),
        high_digits(low >> 32) + low_digit(high),
        high_digits(high),
    ]
}

/// The lowest 32 bits.
#[inline]
pub(super) fn low_digit(value: u128) -> i64 {
    (value & 0xffff_ffff) as i64
}

/// All bits above the lowest 32, for a number below 2⁹⁵.
#[inline]
pub(super) fn high_digits(value: u128) -> i64 {
    #[expect(
        clippy::cast_possible_truncation,
        reason = "at most 63 bits are left, as the callers' numbers are below 2^95"
    )]
    let digits = (value >> 32) as i64;
    digits
}

#[inline]
pub(super) fn add_to(digits: &mut [i64], parts: &[i64]) {
    for (digit, part) in digits.iter_mut().zip(parts) {
        *digit += part;
    }
}

/// Propagates carries until every digit except the highest is in −2³¹..2³¹. With digits of both signs a small negative sum needs few digits.
pub(super) fn carry(digits: &mut [i64]) {
    let Some((highest, others)) = digits.split_last_mut() else {
        return;
    };
    let mut carried = 0;
    for digit in others {
        let value = *digit + carried;
        *digit = value << 32 >> 32;
        carried = (value - *digit) >> 32;
    }
    *highest += carried;
}

pub(super) fn visit_digits(first: usize, digits: &[i64], mut visit: impl FnMut(usize, i64)) {
    for (index, &digit) in (first..).zip(digits) {
        if digit != 0 {
            visit(index, digit);
        }
    }
}
