//! Rounding of an expanded uncertainty, and of the corresponding value.

/// Rounds an expanded uncertainty to two digits: to the nearest number, or up if the nearest number is lower by 5 % or more.
///
/// ```
/// use taceva_metrology::budget::two_digits;
/// assert_eq!(two_digits(92.48), 92.0);
/// assert_eq!(two_digits(0.048), 0.048);
/// ```
///
/// # Reference
/// EA-4/02 M:2022, 6.3.
pub fn two_digits(expanded: f64) -> f64 {
    let nearest: f64 = format!("{expanded:.1e}").parse().unwrap_or(expanded);
    match nearest < expanded * 0.95 {
        true => nearest + 10_f64.powi(exponent(nearest) - 1),
        false => nearest,
    }
}

/// Decimal exponent of `number` rounded to two digits; 0 for 0.
pub(super) fn exponent(number: f64) -> i32 {
    let text = format!("{number:.1e}");
    text.rsplit('e')
        .next()
        .and_then(|exponent| exponent.parse().ok())
        .unwrap_or_default()
}

/// Half the last place of a standard uncertainty rounded to two digits, JCGM 101, 7.9.2.
pub(super) fn tolerance(u: f64) -> f64 {
    0.5 * 10_f64.powi(exponent(u) - 1)
}

/// Formats `number` with the decimals of `uncertainty` rounded to two digits.
pub(super) fn beside(number: f64, uncertainty: f64) -> String {
    let decimals = usize::try_from(1 - exponent(uncertainty)).unwrap_or_default();
    format!("{number:.decimals$}")
}
