//! Pairs of rows that are consecutive in time, such as the frames of a stream.

use std::collections::BTreeMap;

use taceva_dataset::Table;
use taceva_metrics::STREAM_S;

use crate::evidence::Evidence;

/// Minimum number of samples for a statement about steps.
const LEAST: usize = 10;

/// Step from one row to the next row of the same contact, sensor and table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    /// Row before the step. In a table of several sensor units, this is not always the previous row.
    pub(super) from: usize,
    /// Row after the step.
    pub(super) to: usize,
    pub(super) seconds: f64,
}

/// Steps of a stream of frames.
#[derive(Debug)]
pub(super) struct Stream {
    pub(super) steps: Vec<Step>,
    /// Median of the forward steps, s.
    pub(super) usual_s: f64,
}

impl Stream {
    /// Stream of a recording; `None` for single pictures, single presses, few samples, or missing times.
    pub(super) fn of(evidence: &Evidence<'_>) -> Option<Stream> {
        if is_of_presses(evidence) {
            return None;
        }
        let table = evidence.table;
        let times = table.t_s();
        // Every row of a grating is its own press, whatever the name of its point.
        let is_press = |row: usize| table.kind()[row].is_some();
        let steps: Vec<Step> = by_clock(table, 0..table.rows())
            .into_iter()
            .filter(|(from, to)| table.point_id()[*from] == table.point_id()[*to])
            .filter(|(from, to)| !is_press(*from) && !is_press(*to))
            .filter_map(|(from, to)| {
                let seconds = times[to]? - times[from]?;
                Some(Step { from, to, seconds })
            })
            .collect();
        Stream::of_steps(steps)
    }

    fn of_steps(steps: Vec<Step>) -> Option<Stream> {
        let mut forward: Vec<f64> = steps.iter().map(|step| step.seconds).collect();
        forward.retain(|seconds| *seconds > 0.0);
        forward.sort_by(f64::total_cmp);
        let usual_s = *forward.get(forward.len() / 2)?;
        (forward.len() >= LEAST && usual_s <= STREAM_S).then_some(Stream { steps, usual_s })
    }

    /// Sequences of steps in which each step begins at the end of the previous step.
    pub(super) fn runs(&self) -> Vec<Vec<Step>> {
        let mut runs: Vec<Vec<Step>> = Vec::new();
        let mut ends: BTreeMap<usize, usize> = BTreeMap::new();
        for step in &self.steps {
            let run = ends.remove(&step.from).unwrap_or(runs.len());
            if run == runs.len() {
                runs.push(Vec::new());
            }
            runs[run].push(*step);
            ends.insert(step.to, run);
        }
        runs
    }

    /// Stream of one run whose steps have the lengths `seconds`, s.
    #[cfg(test)]
    pub(super) fn of_seconds(seconds: &[f64]) -> Stream {
        let steps = seconds.iter().zip(0..);
        let steps = steps.map(|(seconds, from)| Step {
            from,
            to: from + 1,
            seconds: *seconds,
        });
        Stream::of_steps(steps.collect()).expect("a stream")
    }
}

/// True for a recording that was made press by press, and not as a stream of frames.
pub(super) fn is_of_presses(evidence: &Evidence<'_>) -> bool {
    let header = evidence.header;
    header.stream.is_none() && header.presses.values().any(|count| *count > 0)
}

/// Pairs of consecutive rows of one clock among `rows`. Every unit of a sensor and every table has a separate clock.
pub(super) fn by_clock(table: &Table, rows: impl Iterator<Item = usize>) -> Vec<(usize, usize)> {
    let (units, tables) = (table.unit_id(), table.source_table());
    let mut last: BTreeMap<(Option<&str>, Option<&str>), usize> = BTreeMap::new();
    rows.filter_map(|row| {
        let clock = (units[row].as_deref(), tables[row].as_deref());
        Some((last.insert(clock, row)?, row))
    })
    .collect()
}

/// Pairs of consecutive rows of one sensor unit among `rows`, ordered by time across tables.
pub(super) fn by_time(table: &Table, rows: &[usize]) -> Vec<(usize, usize)> {
    let (units, times) = (table.unit_id(), table.t_s());
    let seconds = |row: usize| times[row].unwrap_or(f64::NEG_INFINITY);
    let mut ordered = rows.to_vec();
    ordered.sort_by(|one, other| seconds(*one).total_cmp(&seconds(*other)));
    let mut last: BTreeMap<Option<&str>, usize> = BTreeMap::new();
    let ordered = ordered.into_iter();
    ordered
        .filter_map(|row| Some((last.insert(units[row].as_deref(), row)?, row)))
        .collect()
}

pub(super) fn share(part: usize, whole: usize) -> f64 {
    part as f64 / whole.max(1) as f64
}

/// Rows with the same time as the previous row of their clock, from a clock that counts whole seconds or has stopped. `None` unless more than one in
/// ten rows repeat a time.
pub(super) fn repeated(table: &Table) -> Option<Vec<usize>> {
    const SHARE: usize = 10;
    let times = table.t_s();
    let timed: Vec<usize> = (0..table.rows())
        .filter(|row| times[*row].is_some())
        .collect();
    let count = timed.len();
    let rows: Vec<usize> = by_clock(table, timed.into_iter())
        .into_iter()
        .filter(|(before, row)| times[*before] == times[*row])
        .map(|(_, row)| row)
        .collect();
    (rows.len() * SHARE > count).then_some(rows)
}
