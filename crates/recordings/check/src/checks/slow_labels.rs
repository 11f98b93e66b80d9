//! TAC037: labels from a slow table, each used for many pictures.

use std::collections::BTreeMap;

use taceva_core::{Channel, Unit, by_count, counted};
use taceva_dataset::{MappedJoin, Table};

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use crate::stamps::repeated;

pub(super) static CHECK: Check = Check {
    code: "TAC037",
    name: "slow-labels",
    looks_for: "labels slower than pictures: a table is joined by time, and one of its rows labels several rows of the recording",
    hint: "set `pick = \"linear\"` in the [[join]] of the map, or record the labels at least as often as the pictures",
    reads: None,
    find,
};

/// Minimum number of runs of rows with the same label.
const LEAST: usize = 5;
/// Minimum median length of a run, rows. The ninetieth percentile of the lengths is at most `ALIKE` medians, because levels held on purpose vary
/// more.
const ROWS: usize = 2;
const ALIKE: usize = 2;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let (header, table) = (evidence.header, evidence.table);
    // Rows with repeated times cannot be interpolated; TAC036 reports them.
    if repeated(table).is_some() {
        return Vec::new();
    }
    let joins = header.joins.iter();
    let held = joins.filter(|join| join.by == "time" && join.pick.as_deref() != Some("linear"));
    held.filter_map(|join| of_join(evidence, join)).collect()
}

/// Checks the labels of one joined table.
fn of_join(evidence: &Evidence<'_>, join: &MappedJoin) -> Option<Found> {
    let table = evidence.table;
    let prefix = format!("{}.", join.name);
    let from_it = |label: &str| {
        let mut columns = evidence.header.columns.iter();
        columns.any(|column| {
            column.label == label && column.from.iter().any(|from| from.starts_with(&prefix))
        })
    };
    let channels: Vec<(usize, &Channel)> = table
        .channels()
        .iter()
        .enumerate()
        .filter(|(_, channel)| from_it(channel.name()))
        .collect();
    let stretches = Stretches::of(table, &channels)?;
    let name = taceva_core::shown(&join.name);
    let mut message = format!(
        "{} of `{name}` {} {}, up to {} each: labels are up to {:.0} ms old",
        counted(stretches.all.len(), "row"),
        by_count(stretches.all.len(), "labels", "label"),
        counted(stretches.rows, "row"),
        stretches.longest(),
        1e3 * stretches.oldest_s(join.pick.as_deref())
    );
    let changes = channels.iter().filter_map(|(position, channel)| {
        let (mean, most) = stretches.interpolated(table, *position)?;
        Some((most, format!(
            "; `pick = \"linear\"` would change {} by {mean:.3} {unit} on average and by at most {most:.3} {unit}",
            channel.name(),
            unit = channel.unit(),
        ), channel.unit()))
    });
    let of_force = |unit: Unit| matches!(unit, Unit::Newton);
    let greatest = changes.max_by(|one, other| {
        let force = of_force(one.2).cmp(&of_force(other.2));
        force.then(one.0.total_cmp(&other.0))
    })?;
    message += &greatest.1;
    Some(Found::overall(Severity::Warning, message))
}

/// Runs of consecutive rows with the same label, for each clock separately.
struct Stretches {
    all: Vec<Vec<usize>>,
    /// Number of rows in all runs.
    rows: usize,
    times: Vec<Option<f64>>,
}

impl Stretches {
    /// Runs of equal labels of `channels`. `None` if there are few runs, if most have one row, or if their lengths vary as for levels held on
    /// purpose.
    fn of(table: &Table, channels: &[(usize, &Channel)]) -> Option<Stretches> {
        let times = table.t_s();
        let label = |row: usize| -> Option<Vec<u64>> {
            let values = channels
                .iter()
                .map(|(position, _)| table.truth(*position).get(row).map(f64::to_bits));
            values.collect()
        };
        type Clock<'t> = (Option<&'t str>, Option<&'t str>);
        let mut open: BTreeMap<Clock<'_>, (Vec<u64>, Vec<usize>)> = BTreeMap::new();
        let mut all = Vec::new();
        for (row, time) in times.iter().enumerate() {
            let (Some(label), Some(_)) = (label(row), time) else {
                continue;
            };
            let clock = (
                table.unit_id()[row].as_deref(),
                table.source_table()[row].as_deref(),
            );
            let (of, stretch) = open.entry(clock).or_default();
            if *of != label && !stretch.is_empty() {
                all.push(std::mem::take(stretch));
            }
            *of = label;
            stretch.push(row);
        }
        all.extend(open.into_values().map(|(_, stretch)| stretch));
        // Continuous zeros are not measured, or at rest.
        let is_zero = |row: usize| {
            let mut values = channels.iter();
            values.all(|(position, _)| {
                table
                    .truth(*position)
                    .get(row)
                    .is_some_and(|value| value.abs() <= 0.0)
            })
        };
        all.retain(|stretch| !is_zero(stretch[0]));
        let mut lengths: Vec<usize> = all.iter().map(Vec::len).collect();
        lengths.sort_unstable();
        let usual = *lengths.get(lengths.len() / 2)?;
        let long = *lengths.get(lengths.len() * 9 / 10)?;
        let rows = lengths.iter().sum();
        let is_held = usual >= ROWS && long <= ALIKE * usual && all.len() >= LEAST;
        is_held.then(|| Stretches {
            all,
            rows,
            times: times.to_vec(),
        })
    }

    fn longest(&self) -> usize {
        self.all.iter().map(Vec::len).max().unwrap_or_default()
    }

    fn time(&self, row: usize) -> f64 {
        self.times[row].unwrap_or_default()
    }

    /// Maximum age of a label, s: a whole run if the join picks the reading `before`, otherwise half a run.
    fn oldest_s(&self, pick: Option<&str>) -> f64 {
        let spans = self.all.iter().map(|stretch| {
            let (first, last) = (stretch[0], stretch[stretch.len() - 1]);
            self.time(last) - self.time(first)
        });
        let longest = spans.fold(0.0, f64::max);
        match pick {
            Some("before") => longest,
            _ => longest / 2.0,
        }
    }

    /// Mean and maximum difference between the labels and a linear interpolation from run to run.
    fn interpolated(&self, table: &Table, position: usize) -> Option<(f64, f64)> {
        let column = table.truth(position);
        let middle = |stretch: &[usize]| {
            let (first, last) = (stretch[0], stretch[stretch.len() - 1]);
            0.5 * (self.time(first) + self.time(last))
        };
        let (mut sum, mut count, mut most) = (0.0, 0.0, 0.0_f64);
        for pair in self.all.windows(2) {
            let [before, after] = pair else { continue };
            let (from, to) = (middle(before), middle(after));
            let (low, high) = (column.get(before[0])?, column.get(after[0])?);
            if to <= from {
                continue;
            }
            for &row in before.iter().chain(after) {
                let share = (self.time(row) - from) / (to - from);
                if (0.0..=1.0).contains(&share) {
                    let change = (low + share * (high - low) - column.get(row)?).abs();
                    sum += change;
                    count += 1.0;
                    most = most.max(change);
                }
            }
        }
        (count > 0.0).then(|| (sum / count, most))
    }
}
