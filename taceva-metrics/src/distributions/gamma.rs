//! The incomplete gamma function.

use std::f64::consts::TAU;

use super::deviance::{deviance, stirling_error};
use super::tails::Tails;
use crate::elementary::exponential;

/// Regularised incomplete gamma functions P(a, x) and Q(a, x), a > 0, x ≥ 0.
///
/// # Reference
/// Abramowitz and Stegun 6.5.29 and 6.5.31.
pub(super) fn gamma_tails(a: f64, x: f64) -> Tails {
    if x <= 0.0 {
        return Tails::of_below(0.0);
    }
    // xᵃ e⁻ˣ / Γ(a + 1).
    let front = exponential(-stirling_error(a) - deviance(a, x)) / (TAU * a).sqrt();
    if front <= 0.0 {
        return Tails::of_below(if x < a { 0.0 } else { 1.0 });
    }
    if x < a + 1.0 {
        Tails::of_below(front * series(a, x))
    } else {
        Tails::of_above(front * a * fraction(a, x))
    }
}

/// Series in P(a, x) = xᵃ e⁻ˣ / Γ(a + 1) × series: 1 + x/(a + 1) + x²/((a + 1)(a + 2)) + …
fn series(a: f64, x: f64) -> f64 {
    let (mut sum, mut term, mut below) = (1.0, 1.0, a);
    loop {
        below += 1.0;
        term *= x / below;
        let next = sum + term;
        if next <= sum {
            return sum;
        }
        sum = next;
    }
}

/// Continued fraction in Q(a, x) = xᵃ e⁻ˣ / Γ(a) × fraction: 1/(x + 1 − a − 1(1 − a)/(x + 3 − a − 2(2 − a)/(…))), by the method of Lentz.
fn fraction(a: f64, x: f64) -> f64 {
    const LEAST: f64 = 1e-290;
    const MOST: u32 = 1_000_000;
    let mut below = x + 1.0 - a;
    let (mut c, mut d) = (1.0 / LEAST, 1.0 / below);
    let mut result = d;
    for step in 1..MOST {
        let step = f64::from(step);
        let above = -step * (step - a);
        below += 2.0;
        d = 1.0 / least(above * d + below, LEAST);
        c = least(below + above / c, LEAST);
        let factor = c * d;
        result *= factor;
        if (factor - 1.0).abs() <= f64::EPSILON {
            break;
        }
    }
    result
}

/// Returns `value`, or `least` if |`value`| is below `least`.
pub(super) fn least(value: f64, least: f64) -> f64 {
    if value.abs() < least { least } else { value }
}
