//! A shallow spherical shell under a point load.
//!
//! # Reference
//! Reissner (1946): stiffness 4 E t² / (R √(3 (1 − ν²))) at radius R and thickness t, with Young's modulus E and Poisson's ratio ν. At arc length s,
//! the dimple has −(4/π) kei(s/l) of its depth under the load, with the decay length l.

use super::kelvin;
use std::f64::consts::FRAC_PI_4;

/// Decay length of a dimple in a shell of radius R and thickness t: √(R t) / (12 (1 − ν²))^(1/4), in mm.
pub fn decay_length(radius_mm: f64, thickness_mm: f64, poisson_ratio: f64) -> f64 {
    (radius_mm * thickness_mm).sqrt() / (12.0 * (1.0 - poisson_ratio * poisson_ratio)).sqrt().sqrt()
}

/// Depth of the dimple at `arc` decay lengths from the load, relative to its depth under the load.
pub fn dimple(arc: f64) -> f64 {
    -kelvin::kei(arc) / FRAC_PI_4
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Stiffness under a point load, in N/mm, for depths up to about the thickness of the shell.
    fn point_stiffness(
        young_modulus_mpa: f64,
        radius_mm: f64,
        thickness_mm: f64,
        poisson_ratio: f64,
    ) -> f64 {
        let bending = (3.0 * (1.0 - poisson_ratio * poisson_ratio)).sqrt();
        4.0 * young_modulus_mpa * thickness_mm * thickness_mm / (radius_mm * bending)
    }

    #[test]
    fn the_dimple_is_one_deep_under_the_load_and_has_a_raised_rim() {
        assert!((dimple(0.0) - 1.0).abs() < 1e-12);
        assert!(dimple(4.5) < 0.0);
    }

    #[test]
    fn a_millimetre_skin_on_a_dome_of_20_mm_has_the_stiffness_and_reach_of_the_bench_model() {
        assert!((point_stiffness(0.6, 20.0, 1.0, 0.5) - 0.08).abs() < 1e-9);
        assert!((decay_length(20.0, 1.0, 0.5) - 2.58).abs() < 0.005);
    }
}
