//! Exact sums of one pair of depth maps, true and predicted.

use taceva_metrics::{Dyadic, ExactSum};

use super::map::DepthMap;
use crate::quotient::ratio;
use crate::totals::Totals;

/// Number of sums of a cluster of maps.
pub(super) const SUMS: usize = 14;
/// Number of counts of a cluster of maps.
pub(super) const COUNTS: usize = 10;
/// Totals of a cluster of maps.
pub(super) type DepthTotals = Totals<SUMS, COUNTS>;

/// Indices of the error sums and counts of an area: all valid pixels, or those with contact in the truth. Error: truth − prediction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Area {
    /// Index in `sums` of the sum of absolute errors, mm. The sums of errors and of squared errors follow.
    pub(super) sums: usize,
    /// Index in `counts` of the number of pixels.
    pub(super) pixels: usize,
    /// Index of the greatest absolute error.
    pub(super) greatest: usize,
}

/// All valid pixels.
pub(super) const ALL: Area = Area {
    sums: 0,
    pixels: 0,
    greatest: 0,
};
/// Valid pixels with contact in the truth.
pub(super) const CONTACT: Area = Area {
    sums: 3,
    pixels: 1,
    greatest: 1,
};

/// Index in `sums` of the sum of true depth × predicted depth over all valid pixels, mm².
const TRUTH_BY_PREDICTION: usize = 6;
/// Index in `sums` of the sum of squared predicted depths over all valid pixels, mm².
const PREDICTIONS: usize = 7;
/// Index in `sums` of the sum of the mean absolute errors of maps, mm.
pub(super) const MAP_MAE: usize = 8;
/// Index in `sums` of the sum of the root mean square errors of maps, mm.
pub(super) const MAP_RMSE: usize = 9;
/// Index in `sums` of the sum of the mean errors of maps, mm.
pub(super) const MAP_BIAS: usize = 10;
/// Index in `sums` of the sum of the greatest errors of maps, mm.
pub(super) const MAP_MAX: usize = 11;
/// Index in `sums` of the sum over maps of the overlap (IoU) of true and predicted contact.
pub(super) const MAP_IOU: usize = 12;
/// Index in `sums` of the sum of angles between normals, degrees.
pub(super) const ANGLES: usize = 13;

/// Index in `counts` of the number of maps with a valid pixel.
pub(super) const MAPS: usize = 2;
/// Index in `counts` of the number of pixels with contact in both maps.
pub(super) const BOTH: usize = 3;
/// Index in `counts` of the number of pixels with contact in either map.
pub(super) const EITHER: usize = 4;
/// Index in `counts` of the number of maps with contact in truth or prediction.
pub(super) const CONTACT_MAPS: usize = 5;
/// Index in `counts` of the number of pairs of maps with valid pixels and no contact in either map.
pub(super) const EMPTY_MAPS: usize = 6;
/// Index in `counts` of the number of normals.
pub(super) const NORMALS: usize = 7;
/// Index in `counts` of the number of pixels with a negative depth.
pub(super) const NEGATIVE: usize = 8;
/// Index in `counts` of the number of all maps.
pub(super) const ALL_MAPS: usize = 9;

/// Totals of one pair of maps, and their greatest errors.
pub(super) struct MapSums {
    pub(super) totals: DepthTotals,
    /// Greatest absolute error over all valid pixels and over pixels in contact, mm.
    pub(super) greatest: [f64; 2],
}

impl MapSums {
    /// Sums over the pixels that are valid in both maps, which have the same size. Depths above `gate_mm` are contact.
    pub(super) fn of(truth: &DepthMap, prediction: &DepthMap, gate_mm: f64) -> MapSums {
        let mut sums = MapSums {
            totals: DepthTotals::default(),
            greatest: [0.0; 2],
        };
        for (&truth, &prediction) in truth.mm().iter().zip(prediction.mm()) {
            if !truth.is_nan() && !prediction.is_nan() {
                sums.add_pixel(truth, prediction, gate_mm);
            }
        }
        sums.add_map();
        sums
    }

    /// Adds one valid pixel.
    fn add_pixel(&mut self, truth: f64, prediction: f64, gate_mm: f64) {
        self.add_to(ALL, truth, prediction);
        let DepthTotals { sums, counts } = &mut self.totals;
        sums[TRUTH_BY_PREDICTION].add_product(truth, prediction);
        sums[PREDICTIONS].add_product(prediction, prediction);
        let [true_contact, predicted_contact] = [truth > gate_mm, prediction > gate_mm];
        counts[BOTH] += u64::from(true_contact && predicted_contact);
        counts[EITHER] += u64::from(true_contact || predicted_contact);
        counts[NEGATIVE] += u64::from(truth < 0.0 || prediction < 0.0);
        if true_contact {
            self.add_to(CONTACT, truth, prediction);
        }
    }

    /// Adds one pixel to the sums of `area`: the absolute error, the error truth − prediction and its square, all exactly.
    fn add_to(&mut self, area: Area, truth: f64, prediction: f64) {
        let [absolute, signed, squares] = area_sums(&mut self.totals, area);
        absolute.add(truth.max(prediction));
        absolute.add(-truth.min(prediction));
        signed.add(truth);
        signed.add(-prediction);
        squares.add_product(truth, truth);
        squares.add_product(-2.0 * truth, prediction);
        squares.add_product(prediction, prediction);
        self.totals.counts[area.pixels] += 1;
        let greatest = &mut self.greatest[area.greatest];
        *greatest = greatest.max((truth - prediction).abs());
    }

    /// Adds the scores of the map to the sums over maps.
    fn add_map(&mut self) {
        let totals = &mut self.totals;
        totals.counts[ALL_MAPS] = 1;
        let (Some(mae), Some(bias), Some(rmse)) = (
            mean(totals, ALL, 0),
            mean(totals, ALL, 1),
            root_mean_square(totals, ALL),
        ) else {
            return;
        };
        totals.counts[MAPS] = 1;
        totals.sums[MAP_MAE].add(mae);
        totals.sums[MAP_RMSE].add(rmse);
        totals.sums[MAP_BIAS].add(bias);
        totals.sums[MAP_MAX].add(self.greatest[ALL.greatest]);
        match overlap(totals) {
            Some(overlap) => {
                totals.counts[CONTACT_MAPS] = 1;
                totals.sums[MAP_IOU].add(overlap);
            }
            None => totals.counts[EMPTY_MAPS] = 1,
        }
    }
}

/// Sums of the absolute errors, the errors and the squared errors of `area`.
fn area_sums(totals: &mut DepthTotals, area: Area) -> &mut [ExactSum; 3] {
    let sums = &mut totals.sums[area.sums..area.sums + 3];
    sums.try_into().expect("three sums")
}

/// Mean absolute error of `area` if `which` is 0, or mean of truth − prediction if `which` is 1; `None` without a pixel.
pub(super) fn mean(totals: &DepthTotals, area: Area, which: usize) -> Option<f64> {
    let pixels = totals.counts[area.pixels];
    let sum = totals.sums[area.sums + which].to_dyadic();
    (pixels > 0).then(|| sum.over(&Dyadic::from(pixels)))
}

/// Root mean square error, rounded once; `None` without a pixel.
pub(super) fn root_mean_square(totals: &DepthTotals, area: Area) -> Option<f64> {
    let pixels = totals.counts[area.pixels];
    let squares = totals.sums[area.sums + 2].to_dyadic();
    (pixels > 0).then(|| squares.root_over(&Dyadic::from(pixels)))
}

/// Root mean square of t − s p for true depths t and predicted depths p, rounded once; `None` without a pixel.
///
/// The factor s = Σ t p / Σ p² minimises the root.
pub(super) fn scaled_root_mean_square(totals: &DepthTotals) -> Option<f64> {
    let pixels = totals.counts[ALL.pixels];
    let sum = |index: usize| totals.sums[index].to_dyadic();
    let [squares, products, predictions] = [
        sum(ALL.sums + 2),
        sum(TRUTH_BY_PREDICTION),
        sum(PREDICTIONS),
    ];
    // Σ t² = Σ(t − p)² + 2 Σ t p − Σ p², and Σ(t − s p)² = Σ t² − (Σ t p)² / Σ p².
    let truths = &(&squares + &(&products + &products)) - &predictions;
    let pixels = (pixels > 0).then(|| Dyadic::from(pixels))?;
    if predictions.is_zero() {
        return Some(truths.root_over(&pixels));
    }
    let left = &(&truths * &predictions) - &(&products * &products);
    Some(left.root_over(&(&predictions * &pixels)))
}

/// Ratio of pixels with contact in both maps to pixels with contact in either map; `None` without contact.
pub(super) fn overlap(totals: &DepthTotals) -> Option<f64> {
    let [both, either] = [BOTH, EITHER].map(|index| u128::from(totals.counts[index]));
    (either > 0).then(|| ratio(both, either))
}
