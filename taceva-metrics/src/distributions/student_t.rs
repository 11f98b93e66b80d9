//! Student's t distribution, for positive degrees of freedom, infinity included.

use super::beta::{Share, beta_tails};
use super::normal;
use super::tails::{Tails, positive_quantile};

/// Probabilities P(|T| ≤ |t|) and P(|T| > |t|).
fn central(t: f64, freedom: f64) -> Tails {
    let square = t * t;
    if square.is_infinite() {
        return Tails::of_below(1.0);
    }
    if freedom.is_infinite() {
        return super::gamma::gamma_tails(0.5, square / 2.0);
    }
    match square > 0.0 {
        true => beta_tails(0.5, freedom / 2.0, Share::of(square, freedom)),
        false => Tails::of_below(0.0),
    }
}

/// P(T ≤ t) for `freedom` degrees of freedom above 0.
///
/// ```
/// use taceva_metrics::distributions::student_t;
/// assert!((student_t::below(1.25, 9.0) - 0.878_587_862_727_829_6).abs() < 1e-15);
/// ```
#[must_use]
pub fn below(t: f64, freedom: f64) -> f64 {
    above(-t, freedom)
}

/// P(T > t) for `freedom` degrees of freedom above 0. A small result has full relative accuracy.
///
/// ```
/// use taceva_metrics::distributions::student_t;
/// assert!((student_t::above(1.0, 1.0) - 0.25).abs() < 1e-15);
/// ```
#[must_use]
pub fn above(t: f64, freedom: f64) -> f64 {
    if t.is_nan() || freedom.is_nan() || freedom <= 0.0 {
        return f64::NAN;
    }
    let tails = central(t, freedom);
    if t < 0.0 {
        0.5 + tails.below / 2.0
    } else {
        tails.above / 2.0
    }
}

/// Quantile: t with P(T ≤ t) = `share`, for `freedom` degrees of freedom above 0.
///
/// ```
/// use taceva_metrics::distributions::student_t;
/// assert!((student_t::quantile(0.975, 1.0) / 12.706_204_736_174_705 - 1.0).abs() < 1e-14);
/// let infinite = student_t::quantile(0.975, f64::INFINITY);
/// assert!((infinite - 1.959_963_984_540_054).abs() < 1e-15);
/// ```
#[must_use]
pub fn quantile(share: f64, freedom: f64) -> f64 {
    if freedom.is_nan() || freedom <= 0.0 {
        return f64::NAN;
    }
    if freedom.is_infinite() {
        return normal::quantile(share);
    }
    // Twice the smaller tail is exact.
    let beyond = 2.0 * share.min(1.0 - share);
    let t = positive_quantile(Tails::of_above(beyond), |t| central(t, freedom));
    if share < 0.5 { -t } else { t }
}
