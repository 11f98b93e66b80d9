//! A flat board on a gel. The force depends only on the outline of the board. The relief affects only pictures.

use std::f64::consts::{PI, TAU};

use crate::elastic::kernel::Kernel;
use crate::parameters::Layer;

/// Side of every board, mm.
pub(crate) const SIDE_MM: f64 = 10.0;

/// Stiffness of a bonded layer under a flat board, N/mm, without the stiffening of a closing lattice.
///
/// The board counts as a disc of equal area and radius a under the pressure P/(2π a √(a² − r²)), which is exact on a half-space, at the force P and
/// the distance r from the centre. The kernel L of the layer gives the compliance c: at ν = 1/2, c E a = 3/8 + (1/2π) ∫ (sin x/x)² (3/2) (L(x h/a) −
/// 1) dx, with Young's modulus E and the thickness h.
pub(super) fn layer_stiffness_n_per_mm(layer: &Layer) -> f64 {
    let radius = SIDE_MM / PI.sqrt();
    let thickness = layer.thickness_mm / radius;
    let end = ZETA_MAX / thickness;
    let step = end / f64::from(INTERVALS);
    let correction: f64 = (0..INTERVALS)
        .map(|interval| {
            let x = (f64::from(interval) + 0.5) * step;
            let spectrum = libm::sin(x) / x;
            let kernel = Kernel::of_layer(x * thickness, layer.poisson_ratio);
            spectrum * spectrum * 1.5 * (kernel.normal - 1.0) * step
        })
        .sum();
    layer.young_modulus_mpa * radius / (0.375 + correction / TAU)
}

/// Stiffness of the holder of a board, N/mm. The holder levels itself on the gel. A rigid holder would exceed the force limit of any flat gel within
/// a tenth of a millimetre.
const HOLDER_N_PER_MM: f64 = 1.0;
/// Number of bisection steps for a depth; the final interval is far below a nanometre.
const BISECTIONS: u32 = 40;

/// Depth of a board in the gel, mm, for a holder `travel_mm` below first touch. `force_n` gives the force of the gel at a depth.
pub(super) fn depth_under_holder_mm(travel_mm: f64, force_n: impl Fn(f64) -> f64) -> f64 {
    let (mut low, mut high) = (0.0, travel_mm);
    for _ in 0..BISECTIONS {
        let middle = 0.5 * (low + high);
        if force_n(middle) < HOLDER_N_PER_MM * (travel_mm - middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Upper end of the integral, at which the correction of the layer has decayed.
const ZETA_MAX: f64 = 14.0;
/// Number of intervals of the midpoint rule. The integrand is smooth and even.
const INTERVALS: u32 = 2000;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::elastic::hertz;

    fn layer(thickness_mm: f64) -> Layer {
        Layer {
            thickness_mm,
            young_modulus_mpa: 1.0,
            poisson_ratio: 0.5,
            stiffening_per_mm: 0.0,
        }
    }

    #[test]
    fn on_a_thick_gel_a_board_is_boussinesq_s_punch() {
        let radius = SIDE_MM / PI.sqrt();
        let punch = 2.0 * hertz::reduced_modulus(1.0, 0.5) * radius;
        let board = layer_stiffness_n_per_mm(&layer(1e4));
        assert!((board / punch - 1.0).abs() < 2e-3, "{board} {punch}");
    }

    #[test]
    fn board_and_holder_share_the_way_as_springs_in_series_do() {
        let gel = 3.0;
        let depth = depth_under_holder_mm(0.8, |depth| gel * depth);
        assert!((depth - 0.8 * HOLDER_N_PER_MM / (HOLDER_N_PER_MM + gel)).abs() < 1e-9);
    }

    #[test]
    fn a_thin_gel_holds_a_board_up_much_harder() {
        let ratio = layer_stiffness_n_per_mm(&layer(4.25)) / layer_stiffness_n_per_mm(&layer(1e4));
        assert!((3.0..8.0).contains(&ratio), "{ratio}");
    }
}
