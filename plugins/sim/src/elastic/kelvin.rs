//! Kelvin's function kei, the shape of a dimple in a shallow shell.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2, FRAC_PI_4, FRAC_PI_8};

/// Euler's constant γ.
const EULER: f64 = 0.577_215_664_901_532_9;

/// Argument up to which the power series has the required digits. For greater arguments, the asymptotic series has ten digits.
const CROSSOVER: f64 = 12.0;

/// kei(x) = Im K₀(x e^(iπ/4)) for x ≥ 0, to 10⁻⁹.
///
/// # Reference
/// Abramowitz and Stegun, 9.9.12 (series) and 9.7.2 with complex argument (asymptotic).
///
/// ```
/// use taceva_sim::elastic::kelvin::kei;
/// assert!((kei(1.0) + 0.494_994_636_519).abs() < 1e-11);
/// ```
pub fn kei(x: f64) -> f64 {
    if x <= 0.0 {
        return -FRAC_PI_4;
    }
    if x < CROSSOVER {
        series(x)
    } else {
        asymptotic(x)
    }
}

/// Power series of kei: −ln(x/2) bei x − (π/4) ber x + Σ (−1)ᵏ ψ(2k+2) (x²/4)^(2k+1) / ((2k+1)!)², with Kelvin's functions ber and bei and the
/// digamma function ψ.
fn series(x: f64) -> f64 {
    let quarter = 0.25 * x * x;
    let logarithm = libm::log(0.5 * x);
    // The running term is (x²/4)ⁿ / (n!)², and `digamma` is ψ(n + 1).
    let (mut term, mut digamma, mut sum) = (1.0, -EULER, 0.0);
    for n in 0..60_u32 {
        let sign = if n % 4 < 2 { 1.0 } else { -1.0 };
        sum += if n % 2 == 0 {
            -FRAC_PI_4 * sign * term
        } else {
            (digamma - logarithm) * sign * term
        };
        let next = f64::from(n + 1);
        term *= quarter / (next * next);
        digamma += 1.0 / next;
    }
    sum
}

/// Asymptotic series of kei: the imaginary part of √(π/2z) e^(−z) Σ aₖ z^(−k) at z = x e^(iπ/4), with a₀ = 1 and aₖ = −aₖ₋₁ (2k−1)² / 8k.
fn asymptotic(x: f64) -> f64 {
    let along = x * FRAC_1_SQRT_2;
    let (mut coefficient, mut sum) = (1.0, 0.0);
    for k in 0..10_u32 {
        let phase = along + FRAC_PI_8 + f64::from(k) * FRAC_PI_4;
        sum -= coefficient * libm::sin(phase);
        let odd = f64::from(2 * k + 1);
        coefficient *= -odd * odd / (8.0 * f64::from(k + 1) * x);
    }
    (FRAC_PI_2 / x).sqrt() * libm::exp(-along) * sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_two_series_meet() {
        for x in [11.0, 12.0, 13.0] {
            assert!((series(x) - asymptotic(x)).abs() < 1e-9, "{x}");
        }
    }

    #[test]
    fn it_falls_to_nothing_far_away() {
        assert!(kei(60.0).abs() < 1e-18);
    }
}
