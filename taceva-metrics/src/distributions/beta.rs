//! The incomplete beta function.

use std::f64::consts::TAU;

use super::deviance::{deviance, stirling_error};
use super::gamma::least;
use super::tails::Tails;
use crate::elementary::exponential;

/// A point x between 0 and 1, as the pair x and 1 − x.
#[derive(Clone, Copy, Debug)]
pub(super) struct Share {
    pub(super) part: f64,
    pub(super) rest: f64,
}

impl Share {
    /// Point x = above / (above + below), for positive arguments.
    pub(super) fn of(above: f64, below: f64) -> Share {
        Share {
            part: 1.0 / (1.0 + below / above),
            rest: 1.0 / (1.0 + above / below),
        }
    }
}

/// Regularised incomplete beta function I(a, b) at `share`, and 1 − I, for a and b > 0.
///
/// # Reference
/// Didonato and Morris, ACM Transactions on Mathematical Software 18 (1992); NIST Digital Library of Mathematical Functions 8.17.
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
        Tails::of_below(front * fraction(a, b, share))
    } else {
        let share = Share {
            part: rest,
            rest: part,
        };
        Tails::of_below(front * fraction(b, a, share)).exchanged()
    }
}

/// Continued fraction in I = xᵃ (1 − x)ᵇ / B(a, b) × fraction, by the method of Lentz. I is the regularised incomplete beta function at x.
///
/// The only difference of nearly equal numbers is a − (a + b) x, computed from the smaller of x and 1 − x.
///
/// # Reference
/// Didonato and Morris, Algorithm 708, ACM Transactions on Mathematical Software 18 (1992), formula 9.
fn fraction(a: f64, b: f64, share: Share) -> f64 {
    const LEAST: f64 = 1e-290;
    const MOST: u32 = 1_000_000;
    let Share { part: x, rest: y } = share;
    let off = match x < y {
        true => a - (a + b) * x,
        false => (a + b) * y - b,
    };
    let mut c = least(a / (a + 1.0) * (off + 1.0), LEAST);
    let (mut d, mut result) = (0.0, c);
    for step in 1..MOST {
        let n = f64::from(step);
        let odd = a + 2.0 * n - 1.0;
        let change = n * (b - n) * x / odd;
        let above = (a + n - 1.0) / odd * (a + b + n - 1.0) * x * change;
        let below = n + change + (a + n) / (a + 2.0 * n + 1.0) * (off + 1.0 + n * (1.0 + y));
        d = 1.0 / least(below + above * d, LEAST);
        c = least(below + above / c, LEAST);
        let factor = c * d;
        result *= factor;
        if (factor - 1.0).abs() <= f64::EPSILON {
            break;
        }
    }
    1.0 / result
}
