//! Rows that follow one another in time, as frames of a stream do.

use super::evidence::Evidence;

/// Samples below which a step says nothing.
const LEAST: usize = 10;
/// The longest median step, in s, of samples that are a stream.
const STREAM_S: f64 = 1.0;

/// A step from a row to the next of the same contact, sensor and table.
#[derive(Clone, Copy, Debug)]
pub(super) struct Step {
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
    /// The stream that a recording is; `None` of single pictures, of few, and without times.
    pub(super) fn of(evidence: &Evidence<'_>) -> Option<Stream> {
        let table = evidence.table;
        let times = table.t_s();
        let is_next = |row: usize| {
            table.point_id()[row] == table.point_id()[row - 1]
                && table.unit_id()[row] == table.unit_id()[row - 1]
                && table.source_table()[row] == table.source_table()[row - 1]
        };
        let steps = (1..table.rows()).filter(|row| is_next(*row));
        let steps: Vec<Step> = steps
            .filter_map(|row| {
                let seconds = times[row]? - times[row - 1]?;
                Some(Step { to: row, seconds })
            })
            .collect();
        let mut forward: Vec<f64> = steps.iter().map(|step| step.seconds).collect();
        forward.retain(|seconds| *seconds > 0.0);
        forward.sort_by(f64::total_cmp);
        let usual_s = *forward.get(forward.len() / 2)?;
        (forward.len() >= LEAST && usual_s <= STREAM_S).then_some(Stream { steps, usual_s })
    }
}
