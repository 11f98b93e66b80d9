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

/// Totals of all clusters of maps, and without each.
type Clusters<'a> = LeaveOneOut<'a, SUMS, COUNTS>;
/// Function from totals to a value.
type ValueOf = fn(&DepthTotals) -> Result<f64, Undefined>;

/// Definition of an error of depth with an interval.
struct Definition {
    metric: &'static str,
    variant: Option<&'static str>,
    words: &'static str,
    /// Index of the number of samples.
    count: usize,
    range: fn(Result<f64, Undefined>) -> Range,
    value: ValueOf,
}

/// Errors of depth with an interval, in order.
const ERRORS: [Definition; 10] = [
    Definition {
        metric: "depth_mae",
        variant: None,
        words: "mean |truth - prediction| over valid pixels",
        count: ALL.pixels,
        range: error,
        value: |totals| of_area(totals, ALL, mean(totals, ALL, 0)),
    },
    Definition {
        metric: "depth_mae",
        variant: Some("per_map"),
        words: "mean of the maps' own mean |truth - prediction|",
        count: MAPS,
        range: error,
        value: |totals| of_maps(totals, MAP_MAE),
    },
    Definition {
        metric: "depth_mae",
        variant: Some("in_contact"),
        words: "mean |truth - prediction| over pixels with contact in the truth",
        count: CONTACT.pixels,
        range: error,
        value: |totals| of_area(totals, CONTACT, mean(totals, CONTACT, 0)),
    },
    Definition {
        metric: "depth_rmse",
        variant: None,
        words: "root of the mean squared error over valid pixels",
        count: ALL.pixels,
        range: error,
        value: |totals| of_area(totals, ALL, root_mean_square(totals, ALL)),
    },
    Definition {
        metric: "depth_rmse",
        variant: Some("per_map"),
        words: "mean of the maps' own root mean squared errors",
        count: MAPS,
        range: error,
        value: |totals| of_maps(totals, MAP_RMSE),
    },
    Definition {
        metric: "depth_rmse",
        variant: Some("in_contact"),
        words: "root of the mean squared error over pixels with contact in the truth",
        count: CONTACT.pixels,
        range: error,
        value: |totals| of_area(totals, CONTACT, root_mean_square(totals, CONTACT)),
    },
    Definition {
        metric: "depth_rmse",
        variant: Some("scaled"),
        words: "root of the mean squared error of predictions times the one best factor",
        count: ALL.pixels,
        range: error,
        value: |totals| of_area(totals, ALL, scaled_root_mean_square(totals)),
    },
    Definition {
        metric: "depth_bias",
        variant: None,
        words: "mean truth - prediction over valid pixels",
        count: ALL.pixels,
        range: signed,
        value: |totals| of_area(totals, ALL, mean(totals, ALL, 1)),
    },
    Definition {
        metric: "depth_bias",
        variant: Some("per_map"),
        words: "mean of the maps' own mean truth - prediction",
        count: MAPS,
        range: signed,
        value: |totals| of_maps(totals, MAP_BIAS),
    },
    Definition {
        metric: "depth_bias",
        variant: Some("in_contact"),
        words: "mean truth - prediction over pixels with contact in the truth",
        count: CONTACT.pixels,
        range: signed,
        value: |totals| of_area(totals, CONTACT, mean(totals, CONTACT, 1)),
    },
];

impl DepthState {
    /// Scores of all maps. The constant of errors is the mean map of training if the task has it, and that of normals is a flat surface.
    #[must_use]
    pub fn scores(&self) -> Vec<TaskScore> {
        let clusters = Clusters::of(&self.clusters);
        let mut scores: Vec<TaskScore> = Vec::new();
        for definition in &ERRORS {
            let estimate = clusters.estimate(
                definition.count,
                definition.range,
                definition.value,
                (definition.value)(&self.constant).ok(),
            );
            let words = self.gated(definition.words);
            let score = millimetres(definition.metric, words, estimate);
            scores.push(match definition.variant {
                Some(variant) => score.variant(variant),
                None => score,
            });
        }
        scores.extend(self.greatest_scores(&clusters));
        scores.extend(self.overlap_scores(&clusters));
        scores.push(self.normal_score(&clusters));
        scores
    }

    /// Greatest errors. A maximum has no interval; the mean of the maps' own has one.
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
        let per_map = |totals: &DepthTotals| of_maps(totals, MAP_MAX);
        let of_maps = clusters.estimate(MAPS, error, per_map, per_map(&self.constant).ok());
        let words = "greatest |truth - prediction| over";
        [
            millimetres("depth_max", format!("{words} valid pixels"), greatest(ALL)),
            millimetres(
                "depth_max",
                "mean of the maps' own greatest |truth - prediction|".to_owned(),
                of_maps,
            )
            .variant("per_map"),
            millimetres(
                "depth_max",
                self.gated(&format!("{words} pixels with contact in the truth")),
                greatest(CONTACT),
            )
            .variant("in_contact"),
        ]
    }

    /// Overlap of areas of contact: over all pixels, and the mean of maps.
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
                format!("mean of the maps' own {words}, maps without contact left out"),
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

    /// `words`, with the gate behind a definition of contact.
    fn gated(&self, words: &str) -> String {
        match words.contains("contact") {
            true => format!("{words} (above {} mm)", self.task.gate_mm()),
            false => words.to_owned(),
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

/// `value` of an area, or the reason that it has no pixel.
fn of_area(totals: &DepthTotals, area: Area, value: Option<f64>) -> Result<f64, Undefined> {
    value.ok_or_else(|| match totals.counts[ALL.pixels] {
        0 => without_pixel(totals),
        _ if area.pixels == CONTACT.pixels => Undefined::NoContact,
        _ => Undefined::NoValidPixel,
    })
}

/// Mean of the sum `sum` over maps with a valid pixel.
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
