//! The incomplete beta function.

use std::f64::consts::TAU;

use super::deviance::{deviance, stirling_error};
use super::gamma::least;
use super::tails::Tails;
use crate::stats::exponential::exponential;

/// A point between 0 and 1 by its distances from both.
#[derive(Clone, Copy, Debug)]
pub(super) struct Share {
    pub(super) part: f64,
    pub(super) rest: f64,
}

impl Share {
    /// above / (above + below), both positive.
    pub(super) fn of(above: f64, below: f64) -> Share {
        Share {
            part: 1.0 / (1.0 + below / above),
            rest: 1.0 / (1.0 + above / below),
        }
    }
}

/// Regularised incomplete beta functions I(a, b) of `share` and 1 − I, a and b > 0.
///
/// # Reference
/// Abramowitz and Stegun 26.5.8; NIST Digital Library of Mathematical Functions 8.17.22.
pub(super) fn beta_tails(a: f64, b: f64, share: Share) -> Tails {
    let Share { part, rest } = share;
    if part <= 0.0 || rest <= 0.0 {
        return Tails::of_below(if part <= 0.0 { 0.0 } else { 1.0 });
    }
    let n = a + b;
    let exponent = stirling_error(n)
        - stirling_error(a)
        - stirling_error(b)
        - deviance(a, n * part)
        - deviance(b, n * rest);
    // xᵃ (1 − x)ᵇ / B(a, b) = a b / n × the binomial density.
    let front = exponential(exponent) * (a / n * b / TAU).sqrt();
    if part <= (a + 1.0) / (n + 2.0) {
        Tails::of_below(front / a * fraction(a, b, part))
    } else {
        Tails::of_below(front / b * fraction(b, a, rest)).exchanged()
    }
}

/// The continued fraction of I, by Lentz's method.
fn fraction(a: f64, b: f64, x: f64) -> f64 {
    const LEAST: f64 = 1e-290;
    const MOST: u32 = 1_000_000;
    let mut c = 1.0;
    let mut d = 1.0 / least(1.0 - (a + b) * x / (a + 1.0), LEAST);
    let mut result = d;
    for step in 1..MOST {
        let step = f64::from(step);
        let twice = a + 2.0 * step;
        let mut factor = 1.0;
        let even = step * (b - step) * x / ((twice - 1.0) * twice);
        let odd = -(a + step) * (a + b + step) * x / (twice * (twice + 1.0));
        for numerator in [even, odd] {
            d = 1.0 / least(1.0 + numerator * d, LEAST);
            c = least(1.0 + numerator / c, LEAST);
            factor *= c * d;
        }
        result *= factor;
        if (factor - 1.0).abs() <= f64::EPSILON {
            break;
        }
    }
    result
}
