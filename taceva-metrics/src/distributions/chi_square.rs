//! Chi-square distribution: sums of squares of independent normal numbers.

use taceva_core::random::{Draws, open_unit};

use super::gamma::gamma_tails;
use super::normal;
use super::tails::{Tails, positive_quantile};
use crate::elementary::logarithm;

/// P(χ² ≤ x) for `freedom` degrees of freedom above 0.
///
/// ```
/// use taceva_metrics::distributions::chi_square;
/// assert!((chi_square::below(2.0, 2.0) - (1.0 - (-1.0_f64).exp())).abs() < 1e-15);
/// ```
#[must_use]
pub fn below(x: f64, freedom: f64) -> f64 {
    match freedom > 0.0 && !x.is_nan() {
        true => gamma_tails(freedom / 2.0, x / 2.0).below,
        false => f64::NAN,
    }
}

/// P(χ² > x) for `freedom` degrees of freedom above 0. A small result has full relative accuracy.
///
/// ```
/// use taceva_metrics::distributions::chi_square;
/// assert!((chi_square::above(100.0, 2.0) / (-50.0_f64).exp() - 1.0).abs() < 1e-13);
/// ```
#[must_use]
pub fn above(x: f64, freedom: f64) -> f64 {
    match freedom > 0.0 && !x.is_nan() {
        true => gamma_tails(freedom / 2.0, x / 2.0).above,
        false => f64::NAN,
    }
}

/// Quantile: x with P(χ² ≤ x) = `share`, for `freedom` degrees of freedom above 0.
///
/// ```
/// use taceva_metrics::distributions::chi_square;
/// assert!((chi_square::quantile(0.975, 60.0) / 83.297_674_877_173_19 - 1.0).abs() < 1e-14);
/// ```
#[must_use]
pub fn quantile(share: f64, freedom: f64) -> f64 {
    match freedom > 0.0 {
        true => positive_quantile(Tails::of_below(share), |x| {
            gamma_tails(freedom / 2.0, x / 2.0)
        }),
        false => f64::NAN,
    }
}

/// Random χ² number with `freedom` degrees of freedom. The same `draws`, `counter` and `freedom` give the same number.
///
/// ```
/// use taceva_metrics::distributions::chi_square;
/// use taceva_core::random::Draws;
/// let draws = Draws::new(7);
/// let mean = (0..4000).map(|at| chi_square::draw(draws, at, 5.0)).sum::<f64>() / 4000.0;
/// assert!((mean - 5.0).abs() < 0.2);
/// ```
///
/// # Reference
/// Marsaglia and Tsang, A simple method for generating gamma variables, ACM Transactions on Mathematical Software 26 (2000).
#[must_use]
pub fn draw(draws: Draws, counter: u64, freedom: f64) -> f64 {
    let shape = freedom / 2.0;
    if shape.is_nan() || shape <= 0.0 {
        return f64::NAN;
    }
    let tries = draws.of(counter);
    // A shape below 1 is raised by 1, and the drawn number is multiplied by a power of a uniform number.
    let (raised, lowered) = match shape < 1.0 {
        true => {
            let unit = open_unit(tries.bits(0));
            let lowered = crate::elementary::exponential(logarithm(unit) / shape);
            (shape + 1.0, lowered)
        }
        false => (shape, 1.0),
    };
    let d = raised - 1.0 / 3.0;
    let c = 1.0 / (9.0 * d).sqrt();
    let mut at = 1;
    loop {
        let normal = normal::quantile(open_unit(tries.bits(at)));
        let unit = open_unit(tries.bits(at + 1));
        at += 2;
        let root = 1.0 + c * normal;
        if root <= 0.0 {
            continue;
        }
        let cube = root * root * root;
        let square = normal * normal;
        let is_taken = unit < 1.0 - 0.0331 * square * square
            || logarithm(unit) < square / 2.0 + d - d * cube + d * logarithm(cube);
        if is_taken {
            return 2.0 * d * cube * lowered;
        }
    }
}
