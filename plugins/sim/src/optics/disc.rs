//! Dark discs: the markers of a gel.

use super::band::Band;
use super::raster::Raster;
use crate::number::{count, narrow};

/// Attenuation by a disc, as a function of the squared distance from its centre.
#[derive(Clone, Debug)]
pub(super) struct Disc {
    /// Share of the light that passes, by squared distance from the centre.
    left: [f32; BINS + 1],
    bins_per_square: f32,
    reach: f32,
}

/// Parameters of a disc. Lengths have the unit of the raster.
#[derive(Clone, Copy, Debug)]
pub(super) struct DiscSpec {
    /// Radius at which the darkness is half of the darkness at the centre.
    pub(super) radius: f64,
    /// Absorbed part of the light at its centre: 0 to 1.
    pub(super) darkness: f64,
    /// Scale of the logistic edge of the disc.
    pub(super) edge: f64,
}

const BINS: usize = 256;
/// Reach of a disc beyond its radius, in edge scales. The darkness at the reach, 7·10⁻³, is subtracted, so that the disc ends without a step.
const EDGES: f64 = 5.0;

impl Disc {
    /// Creates a disc for pixels of `raster`. Its edge is at least a quarter of a pixel wide.
    pub(super) fn new(spec: DiscSpec, raster: &Raster) -> Disc {
        let pixel = 0.5 * f64::from(raster.pitch[0] + raster.pitch[1]);
        let edge = (spec.edge * spec.edge + pixel * pixel / 16.0).sqrt();
        let reach = spec.radius + EDGES * edge;
        let cover = |distance: f64| 1.0 / (1.0 + libm::exp((distance - spec.radius) / edge));
        let left = std::array::from_fn(|bin| {
            let distance = reach * (count(bin) / count(BINS)).sqrt();
            narrow(1.0 - spec.darkness * (cover(distance) - cover(reach)))
        });
        Disc {
            left,
            bins_per_square: narrow(count(BINS) / (reach * reach)),
            reach: narrow(reach),
        }
    }

    /// Darkens the pixels of `band` around `x`, `y`.
    #[inline(always)]
    pub(super) fn stamp(&self, raster: &Raster, x: f32, y: f32, band: &mut Band<'_>) {
        let columns = raster.columns(x, self.reach);
        let first = band.first_row;
        for row in band.rows_among(raster.rows(y, self.reach)) {
            let dy = raster.y(row) - y;
            let start = band.channels * columns.start;
            let end = band.channels * columns.end;
            let channels = band.channels;
            let pixels = band.row_mut(row - first)[start..end].chunks_exact_mut(channels);
            for (pixel, column) in pixels.zip(columns.clone()) {
                let dx = raster.x(column) - x;
                let left = self.left(dx * dx + dy * dy);
                for light in pixel {
                    *light *= left;
                }
            }
        }
    }

    #[inline(always)]
    fn left(&self, distance_squared: f32) -> f32 {
        let place = distance_squared * self.bins_per_square;
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a square is not negative, and the index is clamped to the table"
        )]
        let bin = (place as usize).min(BINS - 1);
        let fraction = (place - narrow(count(bin))).min(1.0);
        self.left[bin] + fraction * (self.left[bin + 1] - self.left[bin])
    }
}
