//! Mean of the pixels of each cell, rounded once, or the difference of this mean from the mean in a reference frame.

use taceva_core::{Frame, FrameInfo, PixelFormat, single};

use super::area::AreaSums;
use super::cell_features::CellFeatures;
use super::spec::{Color, FeatureSpec};

/// Weights of red, green and blue in gray, in thousandths (Rec. ITU-R BT.601).
pub(super) const LUMA: [i64; 3] = [299, 587, 114];
pub(super) const LUMA_SUM: i64 = 1000;

/// True if frames of `format` must be converted to gray for features in `color`.
pub(super) fn mixes(color: Color, format: PixelFormat) -> bool {
    color == Color::Gray && format.samples() == 3
}

/// Features that are the mean pixel value of each cell. Sums are integers until one final division, so a feature is the exact average rounded once.
#[derive(Debug)]
pub(super) struct Pixels {
    color: Color,
    mixes: bool,
    areas: AreaSums,
    reference: Option<Vec<i64>>,
}

impl Pixels {
    pub(super) fn new(spec: &FeatureSpec, info: FrameInfo, reference: Option<&Frame>) -> Pixels {
        let mut pixels = Pixels {
            color: spec.color,
            mixes: mixes(spec.color, info.format),
            areas: AreaSums::new(info, spec.width, spec.height),
            reference: None,
        };
        pixels.reference = reference.map(|frame| {
            let mut sums = Vec::new();
            pixels.for_each_sum(frame, |sum| sums.push(sum));
            sums
        });
        pixels
    }

    fn full_scale(&self) -> i64 {
        let mixed = if self.mixes { LUMA_SUM } else { 1 };
        signed(self.areas.full_scale()) * mixed
    }

    fn for_each_sum(&self, frame: &Frame, mut take: impl FnMut(i64)) {
        if self.mixes {
            self.areas.for_each(frame, |cell| {
                take(
                    cell.iter()
                        .zip(LUMA)
                        .map(|(&sum, weight)| signed(sum) * weight)
                        .sum(),
                );
            });
        } else {
            self.areas
                .for_each(frame, |cell| cell.iter().for_each(|&sum| take(signed(sum))));
        }
    }
}

impl CellFeatures for Pixels {
    fn depth(&self) -> usize {
        self.color.depth()
    }

    /// Writes one value per cell and colour, with full scale 1. Differences from the reference are in −1..1.
    fn write(&self, frame: &Frame, into: &mut [f32]) {
        let full_scale = self.full_scale();
        let mut places = into.iter_mut().enumerate();
        self.for_each_sum(frame, |sum| {
            let (position, place) = places.next().expect("a place for each sum, by contract");
            let reference = self.reference.as_ref().map_or(0, |sums| sums[position]);
            *place = ratio(sum - reference, full_scale);
        });
    }
}

/// Converts the sum of a cell to a signed number. The sum is below 2^48 for a cell of 65,535 × 65,535 pixels of 16 bits. Frames in memory have fewer
/// than 2^32 columns.
pub(super) fn signed(sum: u64) -> i64 {
    i64::try_from(sum).expect("a cell of a frame in memory sums to less than 2^63")
}

/// Divides `sum` by `full_scale` and rounds the quotient to single precision.
pub(super) fn ratio(sum: i64, full_scale: i64) -> f32 {
    single(sum as f64 / full_scale as f64)
}

#[cfg(test)]
mod tests;
