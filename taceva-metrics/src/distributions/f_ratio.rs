//! F distribution: ratio of two independent estimates of one variance.

use super::beta::{Share, beta_tails};
use super::tails::{Tails, positive_quantile};

fn tails(ratio: f64, above: f64, below: f64) -> Tails {
    match ratio > 0.0 {
        true => beta_tails(above / 2.0, below / 2.0, Share::of(above * ratio, below)),
        false => Tails::of_below(0.0),
    }
}

fn is_defined(above: f64, below: f64) -> bool {
    above > 0.0 && below > 0.0 && above.is_finite() && below.is_finite()
}

/// P(F ≤ ratio) for F with `above` degrees of freedom in the numerator and `below` in the denominator, both above 0.
///
/// ```
/// use taceva_metrics::distributions::f_ratio;
/// assert!((f_ratio::below(1.0, 7.0, 7.0) - 0.5).abs() < 1e-15);
/// ```
#[must_use]
pub fn below(ratio: f64, above: f64, below: f64) -> f64 {
    match is_defined(above, below) && !ratio.is_nan() {
        true => tails(ratio, above, below).below,
        false => f64::NAN,
    }
}

/// P(F > ratio), with the arguments of [`below`]. A small result has full relative accuracy.
///
/// ```
/// use taceva_metrics::distributions::f_ratio;
/// assert!((f_ratio::above(0.433_721_030_135_103_2, 18.0, 60.0) - 0.974_106_404_329_046_2).abs() < 1e-14);
/// ```
#[must_use]
pub fn above(ratio: f64, above: f64, below: f64) -> f64 {
    match is_defined(above, below) && !ratio.is_nan() {
        true => tails(ratio, above, below).above,
        false => f64::NAN,
    }
}

/// Quantile: the ratio with P(F ≤ ratio) = `share`, for F with `above` and `below` degrees of freedom.
///
/// ```
/// use taceva_metrics::distributions::f_ratio;
/// assert!((f_ratio::quantile(0.95, 9.0, 60.0) / 2.040_098_055_476_470_3 - 1.0).abs() < 1e-14);
/// ```
#[must_use]
pub fn quantile(share: f64, above: f64, below: f64) -> f64 {
    match is_defined(above, below) {
        true => positive_quantile(Tails::of_below(share), |ratio| tails(ratio, above, below)),
        false => f64::NAN,
    }
}
