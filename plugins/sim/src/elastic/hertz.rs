//! A rigid ball on an elastic half-space.
//!
//! # Reference
//! Hertz (1882); Johnson, *Contact Mechanics* (1985), chapters 3 and 4. The ball counts as a paraboloid, which is valid for contact radii up to a
//! third of the ball's radius. At a contact radius of half the ball's radius, the force of an exact sphere is about 10 % lower.

use std::f64::consts::PI;

/// Reduced modulus E* = E / (1 − ν²) for Young's modulus E and Poisson's ratio ν, in the unit of `young_modulus`.
pub fn reduced_modulus(young_modulus: f64, poisson_ratio: f64) -> f64 {
    young_modulus / (1.0 - poisson_ratio * poisson_ratio)
}

/// Relative radius of two balls, for an equivalent ball on a plane: 1/R = 1/R₁ + 1/R₂.
pub fn relative_radius(first_mm: f64, second_mm: f64) -> f64 {
    first_mm * second_mm / (first_mm + second_mm)
}

/// Contact radius √(R d) of a ball of radius R at the depth d, in mm.
pub fn contact_radius(radius_mm: f64, depth_mm: f64) -> f64 {
    (radius_mm * depth_mm).sqrt()
}

/// Normal force (4/3) E* √R d^(3/2) on a ball of radius R at the depth d, in N, for the reduced modulus E*.
pub fn force(reduced_modulus_mpa: f64, radius_mm: f64, depth_mm: f64) -> f64 {
    4.0 / 3.0 * reduced_modulus_mpa * radius_mm.sqrt() * depth_mm * depth_mm.sqrt()
}

/// Depth of the surface at `rho` contact radii from the centre, per unit of indentation.
///
/// Inside the contact 1 − ρ²/2; outside [(2 − ρ²) asin(1/ρ) + √(ρ² − 1)] / π.
pub fn profile(rho: f64) -> f64 {
    if rho <= 1.0 {
        return 1.0 - 0.5 * rho * rho;
    }
    let squared = rho * rho;
    ((2.0 - squared) * libm::asin(1.0 / rho) + (squared - 1.0).sqrt()) / PI
}

/// Derivative of [`profile`] with respect to ρ, divided by ρ: finite at the centre.
pub fn profile_slope(rho: f64) -> f64 {
    if rho <= 1.0 {
        return -1.0;
    }
    let rim = (rho * rho - 1.0).sqrt() / rho;
    2.0 / PI * (rim / rho - libm::asin(1.0 / rho))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_slope_is_the_derivative_of_the_profile() {
        for rho in [0.3, 0.9, 1.1, 1.5, 3.0] {
            let step = 1e-5;
            let difference = (profile(rho + step) - profile(rho - step)) / (2.0 * step);
            assert!(
                (difference - profile_slope(rho) * rho).abs() < 1e-8,
                "{rho}"
            );
        }
    }

    #[test]
    fn profile_and_slope_are_continuous_at_the_rim() {
        assert!((profile(1.0) - profile(1.0 + 1e-12)).abs() < 1e-9);
        assert!((profile_slope(1.0) - profile_slope(1.0 + 1e-12)).abs() < 1e-5);
    }

    #[test]
    fn a_plane_is_a_ball_without_curvature() {
        assert!((relative_radius(2.0, 1e12) - 2.0).abs() < 1e-9);
    }
}
