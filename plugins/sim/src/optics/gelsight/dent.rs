//! Shape of the coating under a ball, for lookup pixel by pixel.

use super::lamp::{CHUNK, Caster, Slopes};
use crate::displacement::{Load, NODES, Profile, Quantity, node};
use crate::number::narrow;
use crate::optics::simd::Lanes;

/// Effect of one contact at each node of the radial tables: [`Quantity::SinkSlope`], [`Quantity::Bulge`], [`Quantity::BulgeSlope`], and the shadow
/// divided by the radius.
#[derive(Clone, Debug)]
pub(super) struct Dent {
    nodes: Box<[[f32; 4]; NODES]>,
    pub(super) x: f32,
    pub(super) y: f32,
    shear: [f32; 2],
    inverse_radius_squared: f32,
    /// Radius beyond which no slope is visible, in mm.
    pub(super) reach: f32,
}

/// Minimum visible slope. It changes the light by about 0.1 DN, less than the noise of the smallest frames.
const LEAST_SLOPE: f64 = 1e-3;

impl Default for Dent {
    fn default() -> Dent {
        Dent {
            nodes: Box::new([[0.0; 4]; NODES]),
            x: 0.0,
            y: 0.0,
            shear: [1.0, 0.0],
            inverse_radius_squared: 1.0,
            reach: 0.0,
        }
    }
}

impl Dent {
    /// Computes the shape of `profile` under `load`, seen through a lens with a blur of `blur_mm`.
    pub(super) fn take(&mut self, load: &Load, profile: &Profile, blur_mm: f64, shadow: f64) {
        [self.x, self.y] = load.centre_mm.map(narrow);
        self.shear = load.shear_direction().map(narrow);
        self.inverse_radius_squared = profile.inverse_radius_squared();
        self.reach = 0.0;
        let radius = load.contact_radius_mm;
        let sharp = profile.table(Quantity::SinkSlope);
        let bulge = profile.table(Quantity::Bulge);
        let bulge_slope = profile.table(Quantity::BulgeSlope);
        for (position, values) in self.nodes.iter_mut().enumerate() {
            let distance = radius * (node(position) - 1.0).sqrt();
            let sink_slope = if (distance - radius).abs() < 4.0 * blur_mm {
                blurred(profile, distance, blur_mm)
            } else {
                sharp[position]
            };
            *values = [
                sink_slope,
                bulge[position],
                bulge_slope[position],
                narrow(shadow * shade(distance / radius) / distance.max(0.1 * radius)),
            ];
            let slope = distance * f64::from(sink_slope).abs()
                + f64::from(bulge[position]).abs()
                + distance * distance * f64::from(bulge_slope[position]).abs();
            if slope > LEAST_SLOPE {
                self.reach = narrow(distance);
            }
        }
    }

    /// Origin of the shadow of this contact.
    pub(super) fn caster(&self) -> Caster {
        Caster {
            x: self.x,
            y: self.y,
        }
    }

    /// Adds the slopes towards the camera at the pixels `x`, `y` to `slopes`.
    #[inline(always)]
    pub(super) fn add_to(&self, x: &[f32; CHUNK], y: f32, slopes: &mut Slopes) {
        let dy = y - self.y;
        for (i, x) in x.iter().enumerate() {
            let dx = x - self.x;
            let t = 1.0 + (dx * dx + dy * dy) * self.inverse_radius_squared;
            let place = crate::displacement::locate(t);
            let (below, above) = (&self.nodes[place.cell], &self.nodes[place.cell + 1]);
            let [sink_slope, bulge, bulge_slope, shadow] = Lanes::new(*below)
                .towards(Lanes::new(*above), Lanes::splat(place.fraction))
                .to_array();
            let towards = dx * self.shear[0] + dy * self.shear[1];
            let radial = sink_slope - towards * bulge_slope;
            slopes.x[i] += dx * radial - self.shear[0] * bulge;
            slopes.y[i] += dy * radial - self.shear[1] * bulge;
            slopes.shadow[i] = shadow;
        }
    }
}

/// Slope of the sink divided by the radius r, at `distance`, blurred by a Gaussian with the standard deviation `sigma`.
///
/// The slope is a vector field r t(r²). Blurring it in the plane is blurring t as a field in four dimensions. Three of the dimensions lie across r
/// and add their variance to r². Along r, seven Gauss-Hermite nodes are used.
fn blurred(profile: &Profile, distance: f64, sigma: f64) -> f32 {
    let table = profile.table(Quantity::SinkSlope);
    HERMITE
        .iter()
        .map(|(offset, weight)| {
            let along = distance + sigma * offset;
            let squared = along * along + 3.0 * sigma * sigma;
            weight * profile.locate(narrow(squared)).of(table)
        })
        .sum()
}

/// Darkness of the shadow at `rho` contact radii: a band behind the rim.
fn shade(rho: f64) -> f64 {
    if rho > 2.5 {
        return 0.0;
    }
    let from_middle = (rho - 1.2) / 0.25;
    libm::exp(-from_middle * from_middle)
}

/// Nodes and weights of Gauss-Hermite quadrature for the standard normal distribution.
const HERMITE: [(f64, f32); 7] = [
    (-3.750_439_717_725_742, 0.000_548_268_86),
    (-2.366_759_410_734_541, 0.030_757_124),
    (-1.154_405_394_739_968, 0.240_123_18),
    (0.0, 0.457_142_86),
    (1.154_405_394_739_968, 0.240_123_18),
    (2.366_759_410_734_541, 0.030_757_124),
    (3.750_439_717_725_742, 0.000_548_268_86),
];
