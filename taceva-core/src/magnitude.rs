//! Greatest magnitude of numbers that are recorded and scored.

/// Greatest magnitude of a value that is a sample, 2¹⁰²¹ ≈ 2.247 · 10³⁰⁷: sums, differences and means of two such values stay finite.
///
/// Readers reject greater numbers by name. A metric could only count them as invalid.
pub const MAGNITUDE_MAX: f64 = f64::from_bits(0x7fc0_0000_0000_0000);

/// True if `value` can be recorded and scored: finite, with a magnitude up to [`MAGNITUDE_MAX`].
///
/// ```
/// use taceva_core::is_scorable;
/// assert!(is_scorable(-2e307) && !is_scorable(1e308) && !is_scorable(f64::NAN));
/// ```
#[inline]
pub fn is_scorable(value: f64) -> bool {
    value.abs() <= MAGNITUDE_MAX
}
