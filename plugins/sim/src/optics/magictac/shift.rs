//! Where the lattice is seen under a ball, ready to be looked up pixel by pixel.

use crate::displacement::{Load, NODES, Profile, Quantity, locate, node};
use crate::optics::number::narrow;

/// A ball's work on the three layers and on the surface, a node of the radial tables each.
#[derive(Clone, Debug)]
pub(super) struct Shift {
    nodes: Box<[Node; NODES]>,
    pub(super) x: f32,
    pub(super) y: f32,
    shear: [f32; 2],
    inverse_radius_squared: f32,
    /// Beyond this nothing is seen to move, in mm.
    pub(super) reach: f32,
}

/// Outward over r, along the shear, towards its axis over r², for each layer; then the surface's slope over r and the wetting.
type Node = [f32; 12];

/// What happens at a place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moved {
    /// How far each layer has moved: x, then y.
    pub(super) layers: [[f32; 2]; 3],
    /// The gradient of the surface's depth.
    pub(super) gradient: [f32; 2],
    /// Brightening by contact.
    pub(super) wetting: f32,
}

/// A shift by a fiftieth of a pixel of the smallest useful frame (0.2 mm) is not seen.
const LEAST_MM: f64 = 0.004;
/// The part of the reach, counted from outside, over which everything fades.
const FADE: f64 = 0.2;

impl Default for Shift {
    fn default() -> Shift {
        Shift {
            nodes: Box::new([[0.0; 12]; NODES]),
            x: 0.0,
            y: 0.0,
            shear: [1.0, 0.0],
            inverse_radius_squared: 1.0,
            reach: 0.0,
        }
    }
}

impl Shift {
    /// Takes the displacements of the three layers under `load`; the surface's slope is that of the first layer.
    pub(super) fn take(&mut self, load: &Load, profiles: &[Profile; 3], wetting: f64) {
        [self.x, self.y] = load.centre_mm.map(narrow);
        self.shear = load.shear_direction().map(narrow);
        self.inverse_radius_squared = profiles[0].inverse_radius_squared();
        let radius = load.contact_radius_mm;
        let mut reach = 0.0;
        for (position, values) in self.nodes.iter_mut().enumerate() {
            let distance = radius * (node(position) - 1.0).sqrt();
            let mut furthest = 0.0_f64;
            for (layer, profile) in profiles.iter().enumerate() {
                let value = |quantity| profile.table(quantity)[position];
                let moved = [
                    value(Quantity::Outward),
                    value(Quantity::Along),
                    value(Quantity::Radial),
                ];
                values[3 * layer..3 * layer + 3].copy_from_slice(&moved);
                let [outward, along, radial] = moved.map(|part| f64::from(part).abs());
                furthest = furthest.max(distance * (outward + distance * radial) + along);
            }
            values[9] = profiles[0].table(Quantity::SinkSlope)[position];
            values[10] = narrow(wetting / (1.0 + libm::exp(4.0 * (distance - radius))));
            if furthest > LEAST_MM {
                reach = distance;
            }
        }
        self.reach = narrow(reach);
        self.fade(radius, reach);
    }

    /// Lets everything end at the reach without a seam.
    fn fade(&mut self, radius: f64, reach: f64) {
        let start = reach * (1.0 - FADE);
        for (position, values) in self.nodes.iter_mut().enumerate() {
            let distance = radius * (node(position) - 1.0).sqrt();
            if distance > start {
                let left = ((reach - distance) / (reach - start)).clamp(0.0, 1.0);
                let left = narrow(left * left * (3.0 - 2.0 * left));
                for value in values {
                    *value *= left;
                }
            }
        }
    }

    /// What happens at `x`, `y`.
    #[inline(always)]
    pub(super) fn at(&self, x: f32, y: f32) -> Moved {
        let [dx, dy] = [x - self.x, y - self.y];
        let place = locate(1.0 + (dx * dx + dy * dy) * self.inverse_radius_squared);
        let (below, above) = (&self.nodes[place.cell], &self.nodes[place.cell + 1]);
        let mut value = [0.0; 12];
        for lane in 0..12 {
            value[lane] = below[lane] + place.fraction * (above[lane] - below[lane]);
        }
        let [shear_x, shear_y] = self.shear;
        let towards = dx * shear_x + dy * shear_y;
        let mut layers = [[0.0; 2]; 3];
        for (layer, moved) in layers.iter_mut().enumerate() {
            let outward = value[3 * layer] - towards * value[3 * layer + 2];
            let along = value[3 * layer + 1];
            *moved = [
                dx * outward + shear_x * along,
                dy * outward + shear_y * along,
            ];
        }
        Moved {
            layers,
            gradient: [dx * value[9], dy * value[9]],
            wetting: value[10],
        }
    }
}
