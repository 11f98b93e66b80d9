//! Errors from which the scores of a task were computed, by group or contact point.

use std::collections::BTreeMap;

use taceva_core::Channels;
use taceva_results::{EvaluationReport, Samples};

use crate::result::PointErrors;

/// Absolute errors of each of `channels`, summed by the clusters that an interval resamples. Skips angles with a period, because their errors are not plain
/// differences.
pub(super) fn errors(report: &EvaluationReport, channels: &Channels) -> PointErrors {
    let sums = report.samples.as_ref().map(of_samples);
    without_periods(sums.unwrap_or_default(), channels)
}

/// Removes the channels with a period from `sums`.
fn without_periods(mut sums: PointErrors, channels: &Channels) -> PointErrors {
    let periodic = channels.iter().filter(|channel| channel.period().is_some());
    for channel in periodic {
        sums.remove(channel.name());
    }
    sums
}

/// Sums errors by group of the split; without groups, by contact point; without contact points, by sample.
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
    use taceva_core::{Channel, Unit};

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

    #[test]
    fn an_angle_with_a_period_has_no_sums_of_differences() {
        let channel = |name| Channel::named(name, Unit::Degree).expect("a channel");
        let turned = channel("yaw").with_period(360).expect("an angle");
        let channels = Channels::new([turned, channel("tilt")]).expect("channels");
        let table = "sample,tilt,tilt_predicted,yaw,yaw_predicted\ns0,1,1.5,359,1\n";
        let sums = of_samples(&Samples::read(table).expect("samples"));
        assert_eq!(sums.len(), 2);
        let sums = without_periods(sums, &channels);
        let names: Vec<&String> = sums.keys().collect();
        assert_eq!(names, ["tilt"]);
    }
}
