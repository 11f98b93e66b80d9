//! Scores of a task of depth maps.

use taceva_metrics::Range;

use super::pixels::{
    ALL, ALL_MAPS, ANGLES, Area, BOTH, CONTACT, CONTACT_MAPS, COUNTS, DepthTotals, EITHER,
    MAP_BIAS, MAP_IOU, MAP_MAE, MAP_MAX, MAP_RMSE, MAPS, NORMALS, SUMS, mean, overlap,
    root_mean_square, scaled_root_mean_square,
};
use super::state::DepthState;
use crate::estimate::{Estimate, share};
use crate::score::TaskScore;
use crate::totals::{LeaveOneOut, error, signed};
use crate::undefined::Undefined;

/// Totals of all clusters of maps, and for each cluster the totals of all other clusters.
type Clusters<'a> = LeaveOneOut<'a, SUMS, COUNTS>;

/// Error of depth, computed over all pixels and as a mean over maps.
struct Measure {
    metric: &'static str,
    words: &'static str,
    range: fn(Result<f64, Undefined>) -> Range,
    of_pixels: fn(&DepthTotals, Area) -> Option<f64>,
    /// Index in `sums` of the sum over maps of each map's error.
    of_maps: usize,
}

/// Errors of depth with an interval, in order.
const MEASURES: [Measure; 3] = [
    Measure {
        metric: "depth_mae",
        words: "mean |truth - prediction|",
        range: error,
        of_pixels: |totals, area| mean(totals, area, 0),
        of_maps: MAP_MAE,
    },
    Measure {
        metric: "depth_rmse",
        words: "root of the mean squared error",
        range: error,
        of_pixels: root_mean_square,
        of_maps: MAP_RMSE,
    },
    Measure {
        metric: "depth_bias",
        words: "mean truth - prediction",
        range: signed,
        of_pixels: |totals, area| mean(totals, area, 1),
        of_maps: MAP_BIAS,
    },
];

impl DepthState {
    /// Scores of all maps. Errors are compared with those of the task's constant map if given, angles of normals with those of a flat surface.
    #[must_use]
    pub fn scores(&self) -> Vec<TaskScore> {
        let clusters = Clusters::of(&self.clusters);
        let mut scores: Vec<TaskScore> = Vec::new();
        for measure in &MEASURES {
            let of_pixels = |area: Area| {
                let pixels =
                    |totals: &DepthTotals| of_area(totals, area, (measure.of_pixels)(totals, area));
                let constant = pixels(&self.constant).ok();
                clusters.estimate(area.pixels, measure.range, pixels, constant)
            };
            let maps = |totals: &DepthTotals| of_maps(totals, measure.of_maps);
            let constant = maps(&self.constant).ok();
            let per_map = clusters.estimate(MAPS, measure.range, maps, constant);
            let all = [of_pixels(ALL), per_map, of_pixels(CONTACT)];
            scores.extend(self.three(measure.metric, measure.words, all));
        }
        let scaled = |totals: &DepthTotals| of_area(totals, ALL, scaled_root_mean_square(totals));
        let constant = scaled(&self.constant).ok();
        let estimate = clusters.estimate(ALL.pixels, error, scaled, constant);
        let words = "root of the mean squared error of predictions times the one best factor";
        scores.push(millimetres("depth_rmse", words.to_owned(), estimate).variant("scaled"));
        scores.extend(self.greatest_scores(&clusters));
        scores.extend(self.overlap_scores(&clusters));
        scores.push(self.normal_score(&clusters));
        scores
    }

    /// Greatest errors. A maximum has no interval; the mean of the greatest errors of maps has an interval.
    fn greatest_scores(&self, clusters: &Clusters<'_>) -> [TaskScore; 3] {
        let greatest = |area: Area| {
            let of = |totals: &DepthTotals, greatest: &[f64; 2]| {
                let some = (totals.counts[area.pixels] > 0).then_some(greatest[area.greatest]);
                of_area(totals, area, some)
            };
            let constant = of(&self.constant, &self.greatest_of_constant);
            let value = of(clusters.total(), &self.greatest);
            clusters.without_interval(area.pixels, value, constant.ok())
        };
        let maps = |totals: &DepthTotals| of_maps(totals, MAP_MAX);
        let per_map = clusters.estimate(MAPS, error, maps, maps(&self.constant).ok());
        let all = [greatest(ALL), per_map, greatest(CONTACT)];
        self.three("depth_max", "greatest |truth - prediction|", all)
    }

    /// Three scores of a metric: over valid pixels, as the mean over maps, and over pixels in contact.
    fn three(
        &self,
        metric: &'static str,
        words: &str,
        [all, per_map, in_contact]: [Estimate; 3],
    ) -> [TaskScore; 3] {
        let gate = self.task.gate_mm();
        let contact = format!("{words} over pixels with contact in the truth (above {gate} mm)");
        [
            millimetres(metric, format!("{words} over valid pixels"), all),
            millimetres(
                metric,
                format!("mean over maps of the {words} of each map"),
                per_map,
            )
            .variant("per_map"),
            millimetres(metric, contact, in_contact).variant("in_contact"),
        ]
    }

    /// Overlap of contact areas: over all pixels, and as mean over maps.
    fn overlap_scores(&self, clusters: &Clusters<'_>) -> [TaskScore; 2] {
        let all = |totals: &DepthTotals| overlap(totals).ok_or_else(|| without_contact(totals));
        let per_map = |totals: &DepthTotals| match totals.counts[CONTACT_MAPS] {
            0 => Err(without_contact(totals)),
            _ => totals.mean(MAP_IOU, CONTACT_MAPS),
        };
        let of_all = clusters.estimate(EITHER, share, all, all(&self.constant).ok());
        let of_maps = clusters.estimate(CONTACT_MAPS, share, per_map, per_map(&self.constant).ok());
        let gate = self.task.gate_mm();
        let words = format!("pixels above {gate} mm in both maps over those in either");
        let hits = clusters.total();
        [
            TaskScore::new("contact_iou", words.clone(), of_all)
                .beside(hits.counts[BOTH], hits.counts[EITHER]),
            TaskScore::new(
                "contact_iou",
                format!(
                    "mean of the ratios of single maps ({words}), maps without contact left out"
                ),
                of_maps,
            )
            .variant("per_map"),
        ]
    }

    /// Mean angle between normals.
    fn normal_score(&self, clusters: &Clusters<'_>) -> TaskScore {
        let has_size = self.task.pixel_mm().is_some();
        let mean = |totals: &DepthTotals| match (has_size, totals.counts[NORMALS]) {
            (false, _) => Err(Undefined::NoPixelSize),
            (true, 0) => Err(without_pixel(totals)),
            (true, _) => totals.mean(ANGLES, NORMALS),
        };
        let estimate = clusters.estimate(NORMALS, error, mean, mean(&self.constant).ok());
        let words = "mean angle between normals from central differences";
        TaskScore {
            unit: Some("deg"),
            ..TaskScore::new("normal_angle", words, estimate)
        }
    }
}

/// Score in mm.
fn millimetres(metric: &'static str, words: String, estimate: Estimate) -> TaskScore {
    TaskScore {
        unit: Some("mm"),
        ..TaskScore::new(metric, words, estimate)
    }
}

/// `value` of an area, or the reason why the area has no pixel.
fn of_area(totals: &DepthTotals, area: Area, value: Option<f64>) -> Result<f64, Undefined> {
    value.ok_or_else(|| match totals.counts[ALL.pixels] {
        0 => without_pixel(totals),
        _ if area.pixels == CONTACT.pixels => Undefined::NoContact,
        _ => Undefined::NoValidPixel,
    })
}

/// Mean over the maps with a valid pixel, from the sum at index `sum`.
fn of_maps(totals: &DepthTotals, sum: usize) -> Result<f64, Undefined> {
    match totals.counts[MAPS] {
        0 => Err(without_pixel(totals)),
        _ => totals.mean(sum, MAPS),
    }
}

/// Reason for a missing score of maps without a valid pixel.
fn without_pixel(totals: &DepthTotals) -> Undefined {
    match totals.counts[ALL_MAPS] {
        0 => Undefined::Empty,
        _ => Undefined::NoValidPixel,
    }
}

/// Reason for a missing overlap of areas.
fn without_contact(totals: &DepthTotals) -> Undefined {
    match totals.counts[ALL.pixels] {
        0 => without_pixel(totals),
        _ => Undefined::BothEmpty,
    }
}
