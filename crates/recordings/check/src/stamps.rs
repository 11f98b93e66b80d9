//! Rows that follow one another in time, as frames of a stream do.

use std::collections::BTreeMap;

use taceva_dataset::Table;

use crate::evidence::Evidence;

/// Samples below which a step says nothing.
const LEAST: usize = 10;
/// The longest median step, in s, of samples that are a stream.
const STREAM_S: f64 = 1.0;

/// A step from a row to the next of the same contact, sensor and table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
    /// The row that it leads from: with several units in one table not always the one above.
    pub(super) from: usize,
    /// The row that it leads to.
    pub(super) to: usize,
    pub(super) seconds: f64,
}

/// The steps of a stream.
#[derive(Debug)]
pub(super) struct Stream {
    pub(super) steps: Vec<Step>,
    /// The median of those that lead forward, s.
    pub(super) usual_s: f64,
}

impl Stream {
    /// The stream that a recording is; `None` of single pictures, of single presses, of few, and without times.
    pub(super) fn of(evidence: &Evidence<'_>) -> Option<Stream> {
        if is_of_presses(evidence) {
            return None;
        }
        let table = evidence.table;
        let times = table.t_s();
        // Every row of a board is a press of its own, whatever its point is called.
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

    /// Steps of which each begins where the one before it ends.
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

    /// A stream of one run whose steps, in s, are these.
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

/// Tells a recording made press by press, whose pictures are single ones.
pub(super) fn is_of_presses(evidence: &Evidence<'_>) -> bool {
    let header = evidence.header;
    header.stream.is_none() && header.presses.values().any(|count| *count > 0)
}

/// Each of `rows` but the first of its clock, behind the one of the same clock before it: every unit of a sensor has its own, and so has every table.
pub(super) fn by_clock(table: &Table, rows: impl Iterator<Item = usize>) -> Vec<(usize, usize)> {
    let (units, tables) = (table.unit_id(), table.source_table());
    let mut last: BTreeMap<(Option<&str>, Option<&str>), usize> = BTreeMap::new();
    rows.filter_map(|row| {
        let clock = (units[row].as_deref(), tables[row].as_deref());
        Some((last.insert(clock, row)?, row))
    })
    .collect()
}

#[expect(clippy::cast_precision_loss, reason = "rows are far below 2^53")]
pub(super) fn share(part: usize, whole: usize) -> f64 {
    part as f64 / whole.max(1) as f64
}

/// The rows whose time is that of the row before them of the same clock, where they are more than one in ten: stamps of whole seconds, or of a clock
/// that stood still.
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
