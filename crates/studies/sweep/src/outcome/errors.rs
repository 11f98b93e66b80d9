//! Errors behind the scores of a task, by contact point.

use std::collections::BTreeMap;

use taceva_results::{EvaluationReport, Samples};

use crate::result::PointErrors;

/// Absolute errors of each channel, summed by contact point, or by sample if no contact point is known.
pub(super) fn errors(report: &EvaluationReport) -> PointErrors {
    let mut sums = PointErrors::new();
    let Some(samples) = &report.samples else {
        return sums;
    };
    let point = match samples.has("point_id") {
        true => "point_id",
        false => Samples::KEY,
    };
    for channel in samples.channels() {
        let mut points: BTreeMap<&str, (u64, f64)> = BTreeMap::new();
        for row in 0..samples.rows() {
            let pair = channel.pair(row);
            let Some([truth, predicted]) =
                pair.filter(|pair| pair.iter().all(|one| one.is_finite()))
            else {
                continue;
            };
            let cell = points
                .entry(samples.word(point, row).unwrap_or_default())
                .or_default();
            cell.0 += 1;
            cell.1 += (truth - predicted).abs();
        }
        if !points.is_empty() {
            let points = points.into_iter();
            let points = points.map(|(point, (n, sum))| (point.to_owned(), n, sum));
            sums.insert(channel.name.to_owned(), points.collect());
        }
    }
    sums
}
