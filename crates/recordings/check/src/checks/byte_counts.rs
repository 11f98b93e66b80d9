//! TAC045: forces stored in one byte, which wrap around above its greatest count.

use taceva_core::{Channel, Field, Unit, counted};

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC045",
    name: "byte-counts",
    looks_for: "forces stored in one byte that overflowed: at most 256 values, which change slowly but jump by more than 200 counts between neighbouring samples",
    hint: "read both bytes of each force, or keep forces below 255 counts; drop the presses with such a jump",
    reads: None,
    find,
};

/// Minimum number of samples for the check.
const LEAST: usize = 20;
/// Maximum range of one byte, in counts, with a tolerance for rounding.
const BYTE: f64 = 255.5;
/// Number of values that one byte can have.
const COUNTS: f64 = 256.0;
/// Change between consecutive samples above which the force jumps, in counts.
const JUMP: f64 = 200.0;
/// Number of changes that are summed on each side of a jump. In a count that wraps around, both sums have the opposite sign of the jump. After a
/// release, they do not.
const NEAR: usize = 3;
/// Maximum change of a slowly varying force between consecutive samples, in counts. At most one change in `SHARE` may exceed it.
const SLOW: f64 = 64.0;
const SHARE: usize = 8;
/// Tolerance for rounded values, in counts.
const ROUNDING: f64 = 1e-3;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let channels = evidence.table.channels().iter().enumerate();
    let forces = channels.filter(|(_, channel)| channel.unit() == Unit::Newton);
    forces
        .filter_map(|(position, channel)| of_channel(evidence, position, channel))
        .collect()
}

fn of_channel(evidence: &Evidence<'_>, position: usize, channel: &Channel) -> Option<Found> {
    let rows = evidence.labelled(position);
    if rows.len() < LEAST {
        return None;
    }
    let values: Vec<f64> = rows.iter().map(|(_, value)| *value).collect();
    let count = count_of(&values)?;
    let points = evidence
        .table
        .labels(Field::Point, 0..evidence.table.rows())?;
    // The next press may begin at any force.
    let is_of_one_press =
        |one: usize, other: usize| points.get(rows[one].0) == points.get(rows[other].0);
    let change = |from: usize, to: usize| (values[to] - values[from]) / count;
    let pairs = (1..rows.len()).filter(|at| is_of_one_press(at - 1, *at));
    let changes: Vec<(usize, f64)> = pairs.map(|at| (at, change(at - 1, at))).collect();
    let fast = changes.iter().filter(|(_, step)| step.abs() > SLOW);
    let fast = fast.count();
    let goes_on = |at: usize, jump: f64| {
        let mut earlier = at.saturating_sub(NEAR + 1)..at;
        let first = earlier.find(|first| is_of_one_press(*first, at));
        let mut later = (at..rows.len().min(at + NEAR + 1)).rev();
        let last = later.find(|last| is_of_one_press(*last, at));
        let before = first.map_or(0.0, |first| change(first, at - 1));
        let behind = last.map_or(0.0, |last| change(at, last));
        let without_jump = jump + COUNTS.copysign(-jump);
        before * jump < 0.0
            && behind * jump < 0.0
            && without_jump.abs() <= before.abs().min(behind.abs())
    };
    let jumps = changes.iter().filter(|(_, step)| step.abs() > JUMP);
    let jumps = jumps.filter(|(at, jump)| goes_on(*at, *jump));
    let behind: Vec<usize> = jumps.map(|(at, _)| rows[*at].0).collect();
    let first = behind.first()?;
    if fast * SHARE > changes.len() {
        return None;
    }
    let message = format!(
        "{channel} has at most 256 values, {count:.3} N apart, but jumps by more than {JUMP} such steps between {} of neighbours, first in row {}: forces beyond one byte may lack their upper byte",
        counted(behind.len(), "pair"),
        first + 1
    );
    Some(evidence.found(Severity::Warning, message, &behind))
}

/// Greatest common step of all differences of `values`. `None` unless the values span more than [`JUMP`] and at most 255 steps.
fn count_of(values: &[f64]) -> Option<f64> {
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let span = most - least;
    let rounding = ROUNDING * span / BYTE;
    let mut count = span;
    for value in values {
        let mut rest = value - least;
        while rest > rounding {
            let over = count % rest;
            count = rest;
            rest = if rest - over < rounding { 0.0 } else { over };
        }
        if span > BYTE * count {
            return None;
        }
    }
    (span > JUMP * count).then_some(count)
}
