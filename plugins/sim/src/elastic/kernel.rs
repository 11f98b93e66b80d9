//! Response of an elastic layer, bonded to a rigid plate, to a wave of pressure or shear on its surface.
//!
//! With ζ = k h the wave number times the thickness, κ = 3 − 4ν and D = 2κ cosh 2ζ + 4ζ² + 1 + κ²:
//!
//! * pressure → normal displacement: 2(1−ν²)/(E k) · L,  L = (2κ sinh 2ζ − 4ζ)/D;
//! * shear along the wave → along it: 2(1−ν²)/(E k) · M,  M = (2κ sinh 2ζ + 4ζ)/D;
//! * shear across the wave → across it: T/(G k),  T = tanh ζ;
//! * pressure → displacement along the wave, and shear → normal: N/(G k),  N = [2ζ² − κ(κ−1)/2 (cosh 2ζ − 1)]/D.
//!
//! E is Young's modulus, G the shear modulus and ν Poisson's ratio. Numerators and D are multiplied by e^(−2ζ), so that short waves do not overflow.
//!
//! # Reference
//! Plane-strain solution of a layer without displacement at its base; derived here, checked against numerical integration.

/// Four dimensionless responses of the layer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kernel {
    /// L: response of the normal displacement to pressure.
    pub normal: f64,
    /// M: response of the displacement along the wave to shear along the wave.
    pub along: f64,
    /// T: response of the displacement across the wave to shear across the wave.
    pub across: f64,
    /// N: response of the displacement along the wave to pressure, positive outward.
    pub coupling: f64,
}

impl Kernel {
    /// Responses at ζ = `zeta` ≥ 0 of a layer with the given Poisson's ratio.
    pub fn of_layer(zeta: f64, poisson_ratio: f64) -> Kernel {
        let kappa = 3.0 - 4.0 * poisson_ratio;
        let decay = libm::exp(-2.0 * zeta);
        let odd = kappa * (1.0 - decay * decay);
        let linear = 4.0 * zeta * decay;
        let denominator =
            kappa * (1.0 + decay * decay) + (4.0 * zeta * zeta + 1.0 + kappa * kappa) * decay;
        let swell = 2.0 * zeta * zeta * decay;
        let draw = 0.25 * kappa * (kappa - 1.0) * (1.0 - decay) * (1.0 - decay);
        Kernel {
            normal: (odd - linear) / denominator,
            along: (odd + linear) / denominator,
            across: (1.0 - decay) / (1.0 + decay),
            coupling: (swell - draw) / denominator,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_very_thick_layer_answers_as_a_half_space() {
        for poisson_ratio in [0.3, 0.45, 0.5] {
            let thick = Kernel::of_layer(400.0, poisson_ratio);
            // Responses of a half-space: ζ → ∞.
            assert!((thick.normal - 1.0).abs() < 1e-12);
            assert!((thick.along - 1.0).abs() < 1e-12);
            assert!((thick.coupling - (poisson_ratio - 0.5)).abs() < 1e-12);
        }
    }

    #[test]
    fn a_long_wave_squeezes_the_layer_like_a_confined_column() {
        let (zeta, poisson_ratio) = (1e-3, 0.3);
        let kernel = Kernel::of_layer(zeta, poisson_ratio);
        // u = p h (1+ν)(1−2ν) / (E (1−ν)), so L → ζ (1−2ν) / (2 (1−ν)²).
        let confined = zeta * (1.0 - 2.0 * poisson_ratio) / (2.0 * (1.0 - poisson_ratio).powi(2));
        assert!((kernel.normal / confined - 1.0).abs() < 1e-4);
        // u = q h / G, so M → ζ / (1−ν).
        assert!((kernel.along / (zeta / (1.0 - poisson_ratio)) - 1.0).abs() < 1e-4);
    }
}
