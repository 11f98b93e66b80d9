//! Greatest magnitude of recorded and scored numbers.

/// Greatest magnitude of a sample's value, 2¹⁰²¹ ≈ 2.247 · 10³⁰⁷. Sums, differences and means of two values up to this limit stay finite.
///
/// Readers reject a greater number and report its position. A metric can only count such a number as invalid.
pub const MAGNITUDE_MAX: f64 = f64::from_bits(0x7fc0_0000_0000_0000);

/// True if `value` may be recorded and scored: finite, with a magnitude of at most [`MAGNITUDE_MAX`].
///
/// ```
/// use taceva_core::is_scorable;
/// assert!(is_scorable(-2e307) && !is_scorable(1e308) && !is_scorable(f64::NAN));
/// ```
#[inline]
pub fn is_scorable(value: f64) -> bool {
    value.abs() <= MAGNITUDE_MAX
}
