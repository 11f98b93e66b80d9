//! How large a number may be that is recorded and scored.

/// Greatest magnitude of a value that is a sample, 2¹⁰²¹ ≈ 2.247 · 10³⁰⁷: sums, differences and means of two such values stay finite.
///
/// Whoever reads numbers refuses greater ones by name, so that none reaches a metric, which could only count it as invalid.
pub const MAGNITUDE_MAX: f64 = f64::from_bits(0x7fc0_0000_0000_0000);

/// Whether `value` is a number that can be recorded and scored: finite, and of a magnitude up to [`MAGNITUDE_MAX`].
///
/// ```
/// use taceva_core::is_scorable;
/// assert!(is_scorable(-2e307) && !is_scorable(1e308) && !is_scorable(f64::NAN));
/// ```
#[inline]
pub fn is_scorable(value: f64) -> bool {
    value.abs() <= MAGNITUDE_MAX
}
