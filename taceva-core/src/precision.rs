//! Conversions of an `f64` that may round: to `f32`, to an index and to a count.

/// Rounds to the nearest `f32`, the storage format of features, signals and weights.
///
/// ```
/// use taceva_core::single;
/// assert_eq!(single(0.5), 0.5_f32);
/// assert_eq!(f64::from(single(1.0 + 1e-9)), 1.0);
/// ```
#[expect(clippy::cast_possible_truncation, reason = "the rounding is wanted")]
#[inline]
pub const fn single(value: f64) -> f32 {
    value as f32
}

/// Integer part of `value` as an index or a size. NaN and negative values give 0; values above `usize::MAX` give `usize::MAX`.
///
/// ```
/// use taceva_core::whole_size;
/// assert_eq!([2.9, -1.0, f64::NAN].map(whole_size), [2, 0, 0]);
/// ```
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a cast drops the fraction and saturates"
)]
#[inline]
pub const fn whole_size(value: f64) -> usize {
    value as usize
}

/// Integer part of `value` as a count. NaN and negative values give 0; values above `u64::MAX` give `u64::MAX`.
///
/// ```
/// use taceva_core::whole_count;
/// assert_eq!([2.9, -1.0, 1e30].map(whole_count), [2, 0, u64::MAX]);
/// ```
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a cast drops the fraction and saturates"
)]
#[inline]
pub const fn whole_count(value: f64) -> u64 {
    value as u64
}
