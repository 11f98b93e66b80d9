//! Noncentral t distribution: of (Z + δ) / √(χ² / ν), for a standard normal Z, χ² with ν degrees of freedom, and noncentrality δ.

use std::f64::consts::TAU;

use super::deviance::{exponential_excess, stirling_error};
use super::tails::{Tails, least_where};
use super::{normal, student_t};
use crate::elementary::exponential;

/// Tail probabilities at `t`, by the trapezoidal rule for ∫ Φ(t s − δ) f(s) ds over the logarithm of s = √(χ² / ν). Φ is the normal distribution
/// function, f the density of s, and δ the noncentrality.
///
/// The integrand is analytic and decays at both ends, so the number of digits grows in proportion to the number of points.
fn tails(t: f64, freedom: f64, noncentrality: f64) -> Tails {
    /// Limit of e where the density is proportional to exp(−e). A smaller density adds nothing, even to a tail of 10⁻²⁷.
    const GONE: f64 = 100.0;
    let half = freedom / 2.0;
    // 2 (ν/2)^(ν/2) e^(−ν/2) / Γ(ν/2), the density of ln s at s = 1.
    let peak = 2.0 * (half / TAU).sqrt() * exponential(-stirling_error(half));
    // Φ changes over a range of ln s of about 1 / |δ|, the density over 1 / √(2 ν).
    let step = 0.35 / (8.0 + 2.0 * freedom + noncentrality * noncentrality).sqrt();
    let (mut below, mut above) = (0.0, 0.0);
    let mut add = |log: f64| {
        let exponent = half * exponential_excess(2.0 * log);
        let density = exponential(-exponent);
        let z = t * exponential(log) - noncentrality;
        below += density * normal::below(z);
        above += density * normal::above(z);
        exponent < GONE
    };
    add(0.0);
    for side in [step, -step] {
        let mut at = 1.0;
        while add(at * side) {
            at += 1.0;
        }
    }
    Tails {
        below: (below * peak * step).min(1.0),
        above: (above * peak * step).min(1.0),
    }
}

fn is_defined(t: f64, freedom: f64, noncentrality: f64) -> bool {
    freedom > 0.0 && freedom.is_finite() && t.is_finite() && noncentrality.is_finite()
}

/// Probability P(T′ ≤ t) of a noncentral T′, for `freedom` degrees of freedom above 0 and any noncentrality.
///
/// ```
/// use taceva_metrics::distributions::{noncentral_t, normal};
/// // At 0 the denominator does not matter.
/// assert!((noncentral_t::below(0.0, 5.0, 1.5) - normal::below(-1.5)).abs() < 1e-15);
/// ```
#[must_use]
pub fn below(t: f64, freedom: f64, noncentrality: f64) -> f64 {
    match is_defined(t, freedom, noncentrality) {
        true => tails(t, freedom, noncentrality).below,
        false => f64::NAN,
    }
}

/// Probability P(T′ > t) of a noncentral T′, with the arguments of [`below`]. A small result has full relative accuracy.
///
/// ```
/// use taceva_metrics::distributions::{noncentral_t, student_t};
/// let central = student_t::above(2.0, 7.0);
/// assert!((noncentral_t::above(2.0, 7.0, 0.0) / central - 1.0).abs() < 1e-13);
/// ```
#[must_use]
pub fn above(t: f64, freedom: f64, noncentrality: f64) -> f64 {
    match is_defined(t, freedom, noncentrality) {
        true => tails(t, freedom, noncentrality).above,
        false => f64::NAN,
    }
}

/// Quantile: t with P(T′ ≤ t) = `share` for a noncentral T′.
///
/// ```
/// use taceva_metrics::distributions::{noncentral_t, normal};
/// // The factor of a one-sided tolerance limit: 90 % with confidence 99 %, from 43 values.
/// let n = 43.0_f64;
/// let t = noncentral_t::quantile(0.99, n - 1.0, normal::quantile(0.9) * n.sqrt());
/// assert!((t / n.sqrt() - 1.873_953_605_851_2).abs() < 1e-12);
/// ```
#[must_use]
pub fn quantile(share: f64, freedom: f64, noncentrality: f64) -> f64 {
    let is_share = share > 0.0 && share < 1.0;
    if !(is_share && is_defined(0.0, freedom, noncentrality)) {
        return f64::NAN;
    }
    let reached = |t: f64| match share <= 0.5 {
        true => below(t, freedom, noncentrality) >= share,
        false => above(t, freedom, noncentrality) <= 1.0 - share,
    };
    if reached(0.0) {
        // Mirrored: −T′ has the noncentrality −δ.
        -least_where(|t| !reached(-t))
    } else {
        least_where(reached)
    }
}

/// Noncentrality for which a noncentral t variable T′ has P(T′ ≤ `t`) = `share`, for `freedom` degrees of freedom.
///
/// ```
/// use taceva_metrics::distributions::noncentral_t;
/// let off = noncentral_t::noncentrality(0.05, 1.833_112_932_656_237, 9.0);
/// assert!((off - 3.575_384_834_044_819).abs() < 1e-12);
/// ```
#[must_use]
pub fn noncentrality(share: f64, t: f64, freedom: f64) -> f64 {
    let is_share = share > 0.0 && share < 1.0;
    if !(is_share && is_defined(t, freedom, 0.0)) {
        return f64::NAN;
    }
    let reached = |off: f64| match share <= 0.5 {
        true => below(t, freedom, off) <= share,
        false => above(t, freedom, off) >= 1.0 - share,
    };
    if reached(0.0) {
        -least_where(|off| !reached(-off))
    } else {
        least_where(reached)
    }
}

/// Smallest detectable value, in units of a standard deviation that was estimated with `freedom` degrees of freedom.
///
/// A measurement of zero exceeds the detection threshold with probability `alarm`. A measurement of the smallest detectable value stays below the
/// threshold with probability `miss`.
///
/// ```
/// use taceva_metrics::distributions::noncentral_t;
/// assert!((noncentral_t::detection_factor(9.0, 0.05, 0.05) - 3.575_384_834_044_819).abs() < 1e-12);
/// ```
///
/// # Reference
/// Currie, Pure and Applied Chemistry 67 (1995), 3.7.2; ISO 11843-2, 5.1.
#[must_use]
pub fn detection_factor(freedom: f64, alarm: f64, miss: f64) -> f64 {
    noncentrality(miss, student_t::quantile(1.0 - alarm, freedom), freedom)
}
