//! Hankel integrals of a bonded layer under a round contact, in units of the contact radius.
//!
//! On the surface, the half-space has a closed form. Only the correction of the layer is integrated on the surface. This correction decays like
//! e^(−2kh), with the wave number k and the thickness h. Below the surface, the whole response is smooth and is integrated.

use std::f64::consts::{PI, TAU};

use super::radial::Quantity;
use crate::elastic::hertz;
use crate::elastic::kernel::Kernel;

/// Layer in units of the contact: lengths divided by the contact radius, unit modulus, ν = 1/2.
#[derive(Clone, Copy, Debug)]
pub(super) struct Layer {
    /// Thickness in contact radii.
    pub(super) thickness: f64,
    /// Depth below the surface in contact radii.
    pub(super) depth: f64,
}

/// A value for each [`Quantity`], in its order.
pub(super) type Values = [f64; Quantity::ALL.len()];

/// Poisson's ratio of an incompressible gel, as assumed by the force laws.
const POISSON_RATIO: f64 = 0.5;
/// Compliance 2(1 − ν²)/E for Poisson's ratio ν and a Young's modulus E of 1; the next constant is 1/G, with the shear modulus G.
const NORMAL_COMPLIANCE: f64 = 1.5;
const SHEAR_COMPLIANCE: f64 = 3.0;
/// Upper end of the integral on the surface, where the correction of the layer has decayed by e^(−28).
const ZETA_MAX: f64 = 14.0;
/// Upper end of the integral below the surface, where the response has decayed.
const ATTENUATION_MAX: f64 = 30.0;
/// Minimum number of panels. It resolves the decay of an integrand that does not oscillate.
const LEAST_PANELS: f64 = 10.0;
/// Relative blur far from the contact, where the field varies over lengths like the distance r. A blur of 3 % of r changes the field by 5·10⁻⁴. The
/// blur ends the integral at k r = 150, the next constant, with the wave number k.
const BLUR: f64 = 0.03;
const ARGUMENT_MAX: f64 = 150.0;

impl Layer {
    /// Integrates the part without a closed form at `rho` contact radii from the centre.
    pub(super) fn integral(&self, rho: f64) -> Values {
        let on_surface = self.depth <= 0.0;
        let natural = if on_surface {
            ZETA_MAX / self.thickness
        } else {
            ATTENUATION_MAX / self.depth
        };
        let blurred = natural * rho > ARGUMENT_MAX;
        let end = if blurred { ARGUMENT_MAX / rho } else { natural };
        let panels = (end * (rho + 1.0) / PI).ceil().max(LEAST_PANELS);
        let width = end / panels;
        let mut sum = Values::default();
        let mut start = 0.0;
        while start < end - 0.5 * width {
            for (abscissa, weight) in GAUSS {
                let k = start + width * abscissa;
                let blur = if blurred {
                    gauss_bell(BLUR * rho * k)
                } else {
                    1.0
                };
                self.add(&mut sum, k, rho, width * weight * blur / TAU);
            }
            start += width;
        }
        sum
    }

    /// Adds the integrand at wave number `k`.
    fn add(&self, sum: &mut Values, k: f64, rho: f64, weight: f64) {
        let mut kernel = Kernel::of_layer(k * self.thickness, POISSON_RATIO);
        let mut outward = kernel.coupling;
        if self.depth > 0.0 {
            let deep = k * self.depth;
            let decay = libm::exp(-deep);
            kernel.normal *= (1.0 + deep) * decay;
            kernel.along *= decay;
            kernel.across *= decay;
            outward += 0.5 * deep * decay;
        } else {
            kernel.normal -= 1.0;
            kernel.along -= 1.0;
            kernel.across -= 1.0;
        }
        let pressure = weight * hertz_spectrum(k);
        let shear = weight * punch_spectrum(k);
        let sink = pressure * NORMAL_COMPLIANCE * kernel.normal;
        let along = 0.5 * shear * NORMAL_COMPLIANCE * kernel.along;
        let across = 0.5 * shear * SHEAR_COMPLIANCE * kernel.across;
        let bulge = shear * SHEAR_COMPLIANCE * kernel.coupling;
        let [j0, j1_over, j2_over] = bessel(k, rho);
        let j2 = j2_over * rho * rho;
        sum[Quantity::Sink as usize] += sink * j0;
        sum[Quantity::SinkSlope as usize] -= sink * k * j1_over;
        sum[Quantity::Outward as usize] += pressure * SHEAR_COMPLIANCE * outward * j1_over;
        sum[Quantity::Along as usize] += (along + across) * j0 + (along - across) * j2;
        sum[Quantity::Radial as usize] += 2.0 * (along - across) * j2_over;
        sum[Quantity::Bulge as usize] += bulge * j1_over;
        sum[Quantity::BulgeSlope as usize] -= bulge * k * j2_over;
    }

    /// Closed-form values of the half-space at `rho` contact radii from the centre; zero below the surface.
    pub(super) fn closed_form(&self, rho: f64) -> Values {
        let mut values = Values::default();
        if self.depth > 0.0 {
            return values;
        }
        // Unit force: d = 9/(16 E a).
        let depth = 0.5625;
        values[Quantity::Sink as usize] = depth * hertz::profile(rho);
        values[Quantity::SinkSlope as usize] = depth * hertz::profile_slope(rho);
        let inverse = 1.0 / rho.max(1.0);
        let even = 0.5 * (NORMAL_COMPLIANCE + SHEAR_COMPLIANCE) / TAU * libm::asin(inverse);
        let odd = 0.5 * (NORMAL_COMPLIANCE - SHEAR_COMPLIANCE) / TAU
            * inverse
            * (1.0 - inverse * inverse).sqrt();
        values[Quantity::Along as usize] = even + odd;
        values[Quantity::Radial as usize] = 2.0 * odd / (rho * rho).max(1.0);
        values
    }
}

/// Bessel functions J₀(kρ), J₁(kρ)/ρ and J₂(kρ)/ρ² at the wave number `k`, finite at the centre.
fn bessel(k: f64, rho: f64) -> [f64; 3] {
    let x = k * rho;
    if x < 1e-3 {
        let squared = x * x;
        return [
            1.0 - 0.25 * squared,
            0.5 * k * (1.0 - squared / 8.0),
            k * k / 8.0 * (1.0 - squared / 12.0),
        ];
    }
    let (j0, j1) = (libm::j0(x), libm::j1(x));
    // The recurrence loses digits if J₂ is small relative to its parts.
    let j2 = if x < 0.5 {
        libm::jn(2, x)
    } else {
        2.0 * j1 / x - j0
    };
    [j0, j1 / rho, j2 / (rho * rho)]
}

/// Spectrum of Hertz's pressure of unit force at the wave number k: 3 (sin k − k cos k)/k³.
fn hertz_spectrum(k: f64) -> f64 {
    if k < 0.05 {
        return 1.0 - k * k / 10.0 * (1.0 - k * k / 28.0);
    }
    let (sin, cos) = libm::sincos(k);
    3.0 * (sin - k * cos) / (k * k * k)
}

/// Spectrum of the shear of unit force without slip at the wave number k: sin k / k.
fn punch_spectrum(k: f64) -> f64 {
    if k < 1e-4 { 1.0 } else { libm::sin(k) / k }
}

fn gauss_bell(x: f64) -> f64 {
    libm::exp(-0.5 * x * x)
}

/// Gauss-Legendre nodes and weights of order six on 0 to 1: half a period of the integrand to ten digits.
const GAUSS: [(f64, f64); 6] = [
    (0.033_765_242_898_423_99, 0.085_662_246_189_585_18),
    (0.169_395_306_766_867_74, 0.180_380_786_524_069_3),
    (0.380_690_406_958_401_55, 0.233_956_967_286_345_52),
    (0.619_309_593_041_598_5, 0.233_956_967_286_345_52),
    (0.830_604_693_233_132_3, 0.180_380_786_524_069_3),
    (0.966_234_757_101_576, 0.085_662_246_189_585_18),
];
