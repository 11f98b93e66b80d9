//! Student's t distribution for whole degrees of freedom.
//!
//! Only + − × ÷ and √ are used, which IEEE 754 rounds alike everywhere; a platform's own arctangent would not give the same
//! bytes on every machine.

use std::f64::consts::{FRAC_1_PI, FRAC_2_PI};

/// The t within which, to both sides of 0, lies `central` of the distribution.
///
/// Newton's steps from 0 climb towards it, because the probability is concave there; the first that no longer climbs ends
/// them. `central` is in 0..1 and `freedom` at least 1.
pub(super) fn quantile(central: f64, freedom: u32) -> f64 {
    /// Far more than 95 % needs, which takes about ten.
    const MOST_STEPS: usize = 200;
    let mut t = 0.0;
    for _ in 0..MOST_STEPS {
        let missing = central - central_probability(t, freedom);
        let next = t + missing / (2.0 * density(t, freedom));
        if next <= t {
            break;
        }
        t = next;
    }
    t
}

/// P(|T| < t), t ≥ 0.
///
/// # Reference
/// Abramowitz and Stegun, Handbook of Mathematical Functions, 26.7.3 and 26.7.4, with θ = arctan(t / √ν).
fn central_probability(t: f64, freedom: u32) -> f64 {
    let nu = f64::from(freedom);
    let tangent = t / nu.sqrt();
    let cosine = 1.0 / (1.0 + tangent * tangent).sqrt();
    let sine = tangent * cosine;
    let odd = freedom % 2 == 1;
    // 1 + 1/2 cos² + 1·3/(2·4) cos⁴ + … or cos + 2/3 cos³ + 2·4/(3·5) cos⁵ + …, up to the power ν − 2.
    let mut term = if odd { cosine } else { 1.0 };
    let mut series = 0.0;
    for power in (freedom % 2..freedom.saturating_sub(1)).step_by(2) {
        series += term;
        let power = f64::from(power);
        term *= (power + 1.0) / (power + 2.0) * cosine * cosine;
    }
    if odd {
        FRAC_2_PI * (arctangent(tangent) + sine * series)
    } else {
        sine * series
    }
}

/// The density at t: Γ((ν + 1)/2) / (√(νπ) Γ(ν/2)) × cos^(ν + 1) θ.
fn density(t: f64, freedom: u32) -> f64 {
    let nu = f64::from(freedom);
    let cosine = 1.0 / (1.0 + t * t / nu).sqrt();
    // At ν = 1 the quotient of gammas over √π is 1/π, at ν = 2 it is 1/2; each step of two multiplies it by ν / (ν − 1).
    let (start, mut height) = if freedom % 2 == 1 {
        (1, FRAC_1_PI)
    } else {
        (2, 0.5)
    };
    for below in (start..freedom).step_by(2) {
        height *= f64::from(below + 1) / f64::from(below);
    }
    let power = (0..=freedom).fold(1.0, |power, _| power * cosine);
    height / nu.sqrt() * power
}

/// The angle whose tangent is `tangent`, which is not negative.
fn arctangent(tangent: f64) -> f64 {
    /// Halvings of the angle; after them the tangent is below 0.1 and ten terms are enough.
    const HALVINGS: i32 = 4;
    let mut small = tangent;
    for _ in 0..HALVINGS {
        small /= 1.0 + (1.0 + small * small).sqrt();
    }
    let square = small * small;
    let series = (0..10).rev().fold(0.0, |series, term| {
        let sign = if term % 2 == 0 { 1.0 } else { -1.0 };
        series * square + sign / f64::from(2 * term + 1)
    });
    small * series * f64::from(1 << HALVINGS)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_agree_with_published_tables() {
        // Two-sided 95 %, nine decimals.
        let published = [
            (1, 12.706_204_736),
            (2, 4.302_652_730),
            (3, 3.182_446_305),
            (4, 2.776_445_105),
            (5, 2.570_581_836),
            (9, 2.262_157_163),
            (30, 2.042_272_456),
            (31, 2.039_513_446),
            (63, 1.998_340_543),
        ];
        for (freedom, expected) in published {
            let found = quantile(0.95, freedom);
            // Half of the last printed decimal.
            assert!((found - expected).abs() <= 5.1e-10, "{freedom}: {found}");
        }
    }

    #[test]
    fn the_probability_at_a_quantile_is_the_one_asked_for() {
        for freedom in 1..=64 {
            for central in [0.5, 0.9, 0.95, 0.99] {
                let back = central_probability(quantile(central, freedom), freedom);
                // A few roundings of numbers near 1.
                assert!((back - central).abs() < 4e-15, "{freedom}: {back}");
            }
        }
    }

    #[test]
    fn the_arctangent_agrees_with_the_machine_s() {
        for tangent in [0.0, 1e-9, 0.1, 1.0, 2.5, 40.0, 1e6] {
            let difference = arctangent(tangent) - f64::atan(tangent);
            assert!(difference.abs() <= 1e-15, "{tangent}: {difference:e}");
        }
    }
}
