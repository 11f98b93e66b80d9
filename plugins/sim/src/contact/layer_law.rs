//! Contact of a ball with a flat bonded gel.

use super::board;
use super::stand::Answer;
use crate::elastic::layer;
use crate::parameters::Layer;

/// Force law F = (16/9) E √R d^(3/2) ψ(χ) (1 + d/d₀) for a ball of radius R at the depth d, with Young's modulus E. The thickness of the gel enters
/// by ψ(χ), [`layer::force_ratio`] of [`layer::chi`]. The last factor is the stiffening of a closing lattice over the length d₀.
#[derive(Clone, Copy, Debug)]
pub(super) struct LayerLaw {
    layer: Layer,
    board_n_per_mm: f64,
}

/// Factor of the normal and of the tangential law at ν = 1/2: (4/3) / (1 − ν²) and 8 / (2 (1 + ν) (2 − ν)).
const INCOMPRESSIBLE: f64 = 16.0 / 9.0;

impl LayerLaw {
    pub(super) fn new(layer: Layer) -> LayerLaw {
        LayerLaw {
            board_n_per_mm: board::layer_stiffness_n_per_mm(&layer),
            layer,
        }
    }

    /// Force of a flat board, N, and the effective modulus of the gel, MPa.
    pub(super) fn board(&self, depth_mm: f64) -> (f64, f64) {
        let stiffening = 1.0 + self.layer.stiffening_per_mm * depth_mm;
        (
            self.board_n_per_mm * depth_mm * stiffening,
            self.layer.young_modulus_mpa * stiffening,
        )
    }

    #[inline]
    pub(super) fn answer(&self, depth_mm: f64, indenter_radius_mm: f64) -> Answer {
        let half_space_radius = (indenter_radius_mm * depth_mm).sqrt();
        let chi = half_space_radius / self.layer.thickness_mm;
        let modulus =
            self.layer.young_modulus_mpa * (1.0 + self.layer.stiffening_per_mm * depth_mm);
        Answer {
            // √R d^(3/2) = d √(R d).
            force_n: INCOMPRESSIBLE
                * modulus
                * depth_mm
                * half_space_radius
                * layer::force_ratio(chi),
            shear_n_per_mm: INCOMPRESSIBLE * modulus * half_space_radius * layer::shear_ratio(chi),
            radius_mm: half_space_radius * layer::radius_ratio(chi),
            young_modulus_mpa: modulus,
            skin_share: 0.0,
        }
    }
}
