//! Rounding to single precision.

/// The nearest number of single precision, in which features, signals and weights are kept.
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
