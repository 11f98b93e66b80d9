//! Apparent shift of the lattice under a ball, as tables for lookup at each pixel.

use crate::displacement::{Load, NODES, Profile, Quantity, locate, node};
use crate::number::narrow;
use crate::optics::simd::Lanes;

/// Effect of a ball on the three layers and on the surface, at each node of the radial tables.
#[derive(Clone, Debug)]
pub(super) struct Shift {
    nodes: Box<[Node; NODES]>,
    pub(super) x: f32,
    pub(super) y: f32,
    shear: [f32; 2],
    inverse_radius_squared: f32,
    /// Radius beyond which no motion is visible, in mm.
    pub(super) reach: f32,
}

/// Four rows of lanes: outward shift over r, shift along the shear, shift towards the shear's axis over r², and wetting, for the radius r. Each row
/// has one lane per layer. The fourth lane of the first row is the slope of the surface over r. The gradient of the surface is therefore computed
/// together with the shifts.
type Node = [[f32; 4]; 4];

/// Effect at a place: the shift of each layer, and in the fourth lane the gradient of the surface's depth.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moved {
    pub(super) x: Lanes,
    pub(super) y: Lanes,
    /// Brightening by contact.
    pub(super) wetting: f32,
}

/// Minimum visible shift, mm: a fiftieth of a pixel of the smallest useful frame (0.2 mm).
const LEAST_MM: f64 = 0.004;
/// Fraction of the reach, at its outer end, over which the effect fades.
const FADE: f64 = 0.2;

/// Fraction of the full brightening by contact, at `beyond` mm outside the rim.
fn wet(beyond: f64) -> f64 {
    if beyond > 8.0 {
        return 0.0;
    }
    1.0 / (1.0 + libm::exp(4.0 * beyond))
}

impl Default for Shift {
    fn default() -> Shift {
        Shift {
            nodes: Box::new([[[0.0; 4]; 4]; NODES]),
            x: 0.0,
            y: 0.0,
            shear: [1.0, 0.0],
            inverse_radius_squared: 1.0,
            reach: 0.0,
        }
    }
}

impl Shift {
    /// Computes the displacements of the three layers under `load`. The slope of the surface is the slope of the first layer.
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
                values[0][layer] = value(Quantity::Outward);
                values[1][layer] = value(Quantity::Along);
                values[2][layer] = value(Quantity::Radial);
                let [outward, along, radial] =
                    [0, 1, 2].map(|row: usize| f64::from(values[row][layer]).abs());
                furthest = furthest.max(distance * (outward + distance * radial) + along);
            }
            values[0][3] = profiles[0].table(Quantity::SinkSlope)[position];
            values[3][0] = narrow(wetting * wet(distance - radius));
            if furthest > LEAST_MM {
                reach = distance;
            }
        }
        self.reach = narrow(reach);
        self.fade(radius, reach);
    }

    /// Fades all values to 0 at the reach, so that no seam is visible.
    fn fade(&mut self, radius: f64, reach: f64) {
        let start = reach * (1.0 - FADE);
        for (position, values) in self.nodes.iter_mut().enumerate() {
            let distance = radius * (node(position) - 1.0).sqrt();
            if distance > start {
                let left = ((reach - distance) / (reach - start)).clamp(0.0, 1.0);
                let left = narrow(left * left * (3.0 - 2.0 * left));
                for value in values.as_flattened_mut() {
                    *value *= left;
                }
            }
        }
    }

    /// Effect of the ball at `x`, `y`.
    #[inline(always)]
    pub(super) fn at(&self, x: f32, y: f32) -> Moved {
        let [dx, dy] = [x - self.x, y - self.y];
        let place = locate(1.0 + (dx * dx + dy * dy) * self.inverse_radius_squared);
        let (below, above) = (&self.nodes[place.cell], &self.nodes[place.cell + 1]);
        let part = Lanes::splat(place.fraction);
        let row = |row: usize| Lanes::new(below[row]).towards(Lanes::new(above[row]), part);
        let [shear_x, shear_y] = self.shear;
        let towards = Lanes::splat(dx * shear_x + dy * shear_y);
        let outward = row(0).minus(towards.times(row(2)));
        let along = row(1);
        let moved = |from_centre: f32, shear: f32| {
            let outward = Lanes::splat(from_centre).times(outward);
            outward.plus(Lanes::splat(shear).times(along))
        };
        let [below, above] = [below[3][0], above[3][0]];
        Moved {
            x: moved(dx, shear_x),
            y: moved(dy, shear_y),
            wetting: below + place.fraction * (above - below),
        }
    }
}
