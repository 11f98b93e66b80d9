//! Errors behind the scores of a task, by group or contact point.

use std::collections::BTreeMap;

use taceva_results::{EvaluationReport, Samples};

use crate::result::PointErrors;

/// Absolute errors of each channel, summed by the clusters that intervals leave out.
pub(super) fn errors(report: &EvaluationReport) -> PointErrors {
    report.samples.as_ref().map(of_samples).unwrap_or_default()
}

/// Sums by the groups of the split, else by contact point, else by sample.
fn of_samples(samples: &Samples) -> PointErrors {
    let mut sums = PointErrors::new();
    let mut known = [Samples::GROUP, "point_id"].into_iter();
    let point = known.find(|name| samples.has(name));
    let point = point.unwrap_or(Samples::KEY);
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_summed_by_groups_of_the_split_then_by_points_then_by_samples() {
        let names = |columns: &str, cells: &str| -> Vec<String> {
            let rows = (0..2).map(|row| format!("s{row}{cells},1,1.5\n"));
            let rows: String = rows.collect();
            let table = format!("sample{columns},Fz,Fz_predicted\n{rows}");
            let sums = of_samples(&Samples::read(&table).expect("samples"));
            let points = sums["Fz"].iter();
            points.map(|(point, ..)| point.clone()).collect()
        };
        assert_eq!(names(",point_id,group", ",p,cup"), ["cup"]);
        assert_eq!(names(",point_id", ",p"), ["p"]);
        assert_eq!(names("", ""), ["s0", "s1"]);
    }
}
