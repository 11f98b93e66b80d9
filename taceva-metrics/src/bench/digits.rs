//! Number of correct decimal digits of a result.

/// Result of [`digits`] for a value with all bits correct.
pub const ALL_DIGITS: f64 = 17.3;

/// Number of decimal digits in which `value` agrees with `truth`: −log₁₀(|value − truth| / |truth|).
///
/// The result is between 0 (no correct digit) and [`ALL_DIGITS`]. If `truth` is zero, the magnitude of `value` replaces the ratio. The result
/// is the log relative error of NIST's Statistical Reference Datasets (McCullough 1998).
///
/// ```
/// use taceva_metrics::bench::{ALL_DIGITS, digits};
/// assert_eq!(digits(0.25, 0.25), ALL_DIGITS);
/// assert!((digits(1.001, 1.0) - 3.0).abs() < 1e-9);
/// assert_eq!(digits(f64::NAN, 1.0), 0.0);
/// ```
pub fn digits(value: f64, truth: f64) -> f64 {
    let difference = (value - truth).abs();
    if difference == 0.0 {
        return ALL_DIGITS;
    }
    let error = if truth == 0.0 {
        difference
    } else {
        difference / truth.abs()
    };
    let digits = -error.log10();
    if digits > 0.0 {
        digits.min(ALL_DIGITS)
    } else {
        // This branch also gives 0 for NaN, and never −0.
        0.0
    }
}
