//! TAC035: drifting zero of the force transducer, detected by steps or drifts of forces without contact.

use taceva_core::{Channel, Field, Unit};

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use crate::untouched::look_alikes;

pub(super) static CHECK: Check = Check {
    code: "TAC035",
    name: "zero-shift",
    looks_for: "forces and torques of pictures without contact that step or drift over the recording: a transducer that was zeroed again, \
        warms up or creeps",
    hint: "subtract the zero by [zero] of the map, zero the transducer before every press, or import each section as a separate recording",
    reads: Some(Field::Frame),
    find,
};

/// Minimum number of samples on each side of a step. `LEAST` is the minimum number in total.
const SIDE: usize = 4;
const LEAST: usize = 8;
/// Minimum shift of the zero, as a fraction of the 95th percentile of the absolute labels.
const SHARE: f64 = 0.02;
/// Minimum shift of the zero, in standard errors of the shift. The value is large because the position of a step is searched.
const CLEAR: f64 = 6.0;
/// Rounding of labels with few decimals, as a fraction of the 95th percentile of the absolute labels. Rounding does not count as scatter.
const ROUNDING: f64 = 1e-4;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let rows = look_alikes(evidence);
    if rows.len() < LEAST {
        return Vec::new();
    }
    let channels = evidence.table.channels().iter().enumerate();
    let forces = channels
        .filter(|(_, channel)| matches!(channel.unit(), Unit::Newton | Unit::NewtonMillimetre));
    forces
        .filter_map(|(position, channel)| of_channel(evidence, &rows, position, channel))
        .collect()
}

/// Finds a step or drift in the zero of one channel.
fn of_channel(
    evidence: &Evidence<'_>,
    rows: &[usize],
    position: usize,
    channel: &Channel,
) -> Option<Found> {
    let column = evidence.table.truth(position);
    let times = evidence.table.t_s();
    let timed = rows.iter().all(|row| times[*row].is_some());
    let mut points: Vec<(f64, f64, usize)> = rows
        .iter()
        .filter_map(|row| {
            let at = if timed { times[*row]? } else { *row as f64 };
            Some((at, column.get(*row)?, *row))
        })
        .collect();
    points.sort_by(|one, other| one.0.total_cmp(&other.0).then(one.2.cmp(&other.2)));
    let mut all: Vec<f64> = (0..column.len())
        .filter_map(|row| Some(column.get(row)?.abs()))
        .collect();
    all.sort_by(f64::total_cmp);
    let usual = *all.get(all.len().saturating_sub(1) * 19 / 20)?;
    let values: Vec<f64> = points.iter().map(|point| point.1).collect();
    let step = Step::of(&values, ROUNDING * usual)?;
    let drift = Drift::of(&points, ROUNDING * usual)?;
    let is_large = |change: f64| change.abs() > SHARE * usual;
    let unit = channel.unit();
    let after = match timed {
        true => format!("{:.1} s", points[step.at].0 - first_time(evidence)),
        false => format!("row {}", points[step.at].2 + 1),
    };
    let count = points.len();
    let message = if step.residual <= drift.residual {
        let change = step.after - step.before;
        (is_large(change) && change.abs() > CLEAR * step.error).then(|| {
            format!(
                "{channel} of {count} similar pictures without contact steps from {:.3} {unit} to {:.3} {unit} at {after}: the zero has \
                 moved",
                step.before, step.after
            )
        })
    } else {
        (is_large(drift.change) && drift.change.abs() > CLEAR * drift.error).then(|| {
            format!(
                "{channel} of {count} similar pictures without contact drifts by {:.3} {unit} from the first to the last",
                drift.change
            )
        })
    }?;
    let shifted: Vec<usize> = match step.residual <= drift.residual {
        true => points[step.at..].iter().map(|point| point.2).collect(),
        false => points.iter().map(|point| point.2).collect(),
    };
    Some(evidence.found(Severity::Warning, message, &shifted))
}

/// Earliest time stamp of the recording, s.
fn first_time(evidence: &Evidence<'_>) -> f64 {
    let times = evidence.table.t_s().iter().flatten();
    times.copied().fold(f64::INFINITY, f64::min)
}

/// Step between two constant levels, fitted to a series of values by least squares.
#[derive(Clone, Copy, Debug)]
struct Step {
    /// Index of the first value after the step.
    at: usize,
    before: f64,
    after: f64,
    /// Standard error of the difference between the means before and after the step.
    error: f64,
    /// Residual sum of squares around both means.
    residual: f64,
}

impl Step {
    /// Step that fits `values` best; the values must be in order of time. `least` is the minimum scatter, which is due to rounding.
    fn of(values: &[f64], least: f64) -> Option<Step> {
        let mut sums = vec![(0.0, 0.0)];
        for value in values {
            let (sum, squares) = sums[sums.len() - 1];
            sums.push((sum + value, squares + value * value));
        }
        let part = |from: usize, to: usize| -> (f64, f64, f64) {
            let count = number(to - from);
            let sum = sums[to].0 - sums[from].0;
            let squares = sums[to].1 - sums[from].1;
            (count, sum / count, (squares - sum * sum / count).max(0.0))
        };
        let steps = (SIDE..(values.len() + 1).checked_sub(SIDE)?).map(|at| {
            let (before, after) = (part(0, at), part(at, values.len()));
            let residual = before.2 + after.2;
            let freedom = (before.0 + after.0 - 2.0).max(1.0);
            let scatter = (residual / freedom).sqrt().max(least);
            Step {
                at,
                before: before.1,
                after: after.1,
                error: scatter * (1.0 / before.0 + 1.0 / after.0).sqrt(),
                residual,
            }
        });
        steps.min_by(|one, other| one.residual.total_cmp(&other.residual))
    }
}

/// Straight line fitted to values over time by least squares.
#[derive(Clone, Copy, Debug)]
struct Drift {
    /// Change of the line from the first time to the last.
    change: f64,
    error: f64,
    residual: f64,
}

impl Drift {
    fn of(points: &[(f64, f64, usize)], least: f64) -> Option<Drift> {
        let count = number(points.len());
        let (first, last) = (points.first()?.0, points.last()?.0);
        let mean =
            |of: &dyn Fn(&(f64, f64, usize)) -> f64| points.iter().map(of).sum::<f64>() / count;
        let (time, value) = (mean(&|point| point.0), mean(&|point| point.1));
        let (mut times, mut both, mut values) = (0.0, 0.0, 0.0);
        for point in points {
            let (time, value) = (point.0 - time, point.1 - value);
            times += time * time;
            both += time * value;
            values += value * value;
        }
        if times <= 0.0 {
            return Some(Drift {
                change: 0.0,
                error: f64::INFINITY,
                residual: values,
            });
        }
        let slope = both / times;
        let residual = (values - slope * both).max(0.0);
        let scatter = (residual / (count - 2.0).max(1.0)).sqrt().max(least);
        Some(Drift {
            change: slope * (last - first),
            error: scatter / times.sqrt() * (last - first),
            residual,
        })
    }
}

fn number(count: usize) -> f64 {
    count as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn noise(number: usize) -> f64 {
        (number as f64 * 12.9898).sin() * 0.01
    }

    #[test]
    fn a_step_is_found_where_it_is_and_a_line_leaves_more() {
        let values: Vec<f64> = (0..40)
            .map(|number| noise(number) + if number < 25 { 0.0 } else { 1.5 })
            .collect();
        let step = Step::of(&values, 0.0).expect("enough");
        assert_eq!(step.at, 25);
        assert!((step.after - step.before - 1.5).abs() < 0.02 && step.error < 0.02);
        let points: Vec<(f64, f64, usize)> = values
            .iter()
            .enumerate()
            .map(|(row, value)| (row as f64, *value, row))
            .collect();
        assert!(Drift::of(&points, 0.0).expect("a line").residual > step.residual);
    }

    #[test]
    fn a_drift_is_a_line_and_no_step() {
        let points: Vec<(f64, f64, usize)> = (0..40)
            .map(|row| (row as f64, 0.02 * row as f64 + noise(row), row))
            .collect();
        let drift = Drift::of(&points, 0.0).expect("a line");
        assert!((drift.change - 0.78).abs() < 0.05 && drift.change > CLEAR * drift.error);
        let values: Vec<f64> = points.iter().map(|point| point.1).collect();
        assert!(Step::of(&values, 0.0).expect("enough").residual > drift.residual);
    }
}
