//! TAC019: labels later or earlier than their pictures, for instance because of two clocks.

use std::collections::BTreeMap;

use taceva_core::{Field, counted, shown};
use taceva_metrics::STREAM_S;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use crate::stamps::{is_of_presses, repeated};

pub(super) static CHECK: Check = Check {
    code: "TAC019",
    name: "label-lag",
    looks_for: "forces that fit earlier or later pictures better than their own: two clocks with an offset",
    hint: "set the offset as `lag_ms` of the join in the map, or shift one clock before the tables are joined",
    reads: Some(Field::Frame),
    find,
};

/// Minimum number of samples of all streams together for detecting a lag.
const LEAST: usize = 50;
/// Maximum lag that is searched, in steps. At most one in `SHARE` samples may lack a partner at a lag.
const FURTHEST: usize = 60;
const SHARE: usize = 4;
/// Minimum correlation of pictures and forces at the lag. `BETTER` is the minimum factor by which the lag reduces the unexplained variance.
const CLEAR: f64 = 0.6;
const BETTER: f64 = 1.5;
/// Number of parts of the recording. Most parts with a varying force must also show the lag, because a drift can feign a lag of the recording as a
/// whole.
const PARTS: usize = 3;
/// Minimum variance of the force in a part, as a fraction of the greatest variance of a part.
const LOADED: f64 = 0.1;
/// Maximum lag that the slow recovery of a gel explains, s.
const SLOW_GEL_S: f64 = 0.1;

/// Maximum lag as a fraction of the duration of the recording.
const OF_RECORDING: f64 = 0.1;

/// Minimum variance of a varying series, as a fraction of its squared mean.
const VARIES: f64 = 1e-20;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let table = evidence.table;
    let Some(load) = evidence.load() else {
        return Vec::new();
    };
    // Rows with repeated times give no step, and single presses have no lag.
    if repeated(table).is_some() || is_of_presses(evidence) {
        return Vec::new();
    }
    // Another unit of the sensor, or another table, has another clock, so consecutive rows are not consecutive in time.
    let mut streams: BTreeMap<(Option<&str>, Option<&str>), Vec<Instant>> = BTreeMap::new();
    for (row, facts) in evidence.frames.iter().enumerate() {
        let instant = facts.as_ref().and_then(|facts| {
            let light = facts
                .distance
                .unwrap_or(facts.mean.iter().sum::<f64>() / 3.0);
            Some((table.t_s()[row]?, light, table.truth(load).get(row)?.abs()))
        });
        let clock = (
            table.unit_id()[row].as_deref(),
            table.source_table()[row].as_deref(),
        );
        streams.entry(clock).or_default().extend(instant);
    }
    let count: usize = streams.values().map(Vec::len).sum();
    let streams = alike(streams);
    let name = table.channels().as_slice()[load].name();
    let lag = Lag::of(&streams);
    let found = lag.filter(|lag| {
        lag.steps != 0 && is_clear(lag.best, lag.standing) && lag.holds_in_parts(&streams)
    });
    let found = found.map(|lag| {
        let (later, steps) = match lag.steps > 0 {
            true => ("later", lag.steps),
            false => ("earlier", -lag.steps),
        };
        let (severity, cause) = match lag.seconds.abs() > SLOW_GEL_S {
            true => (Severity::Warning, ""),
            false => (
                Severity::Note,
                "; a gel that recovers slowly can cause so short a lag",
            ),
        };
        let message = format!(
            "{name} is about {:.0} ms ({}) {later} than the pictures: the correlation is {:.2} with this shift and {:.2} \
             without, n {}{}{cause}",
            1e3 * lag.seconds.abs(),
            counted(steps.unsigned_abs(), "step"),
            lag.best,
            lag.standing,
            count,
            line(evidence, name, lag.seconds).unwrap_or_default()
        );
        Found::overall(severity, message)
    });
    found.into_iter().collect()
}

/// Import-map entry that removes a lag of `seconds` of the channel `name`. `None` unless the channel is joined by time with a single lag.
fn line(evidence: &Evidence<'_>, name: &str, seconds: f64) -> Option<String> {
    let mut columns = evidence.header.columns.iter();
    let column = columns.find(|column| column.label == name)?;
    let mut joins = evidence.header.joins.iter();
    let join = joins.find(|join| {
        let prefix = format!("{}.", join.name);
        join.by == "time" && column.from.iter().any(|from| from.starts_with(&prefix))
    })?;
    // Without a sign of zero.
    let lag_ms = (join.lag_ms? + 1e3 * seconds).round() + 0.0;
    Some(format!(
        "; `lag_ms = {lag_ms}` in the [[join]] `{}` removes it",
        shown(&join.name)
    ))
}

/// True if the correlation at a lag is strong, and clearly better than `standing`, the correlation without a lag.
fn is_clear(best: f64, standing: f64) -> bool {
    best >= CLEAR && 1.0 - standing.powi(2) >= BETTER * (1.0 - best.powi(2))
}

/// Absolute correlation of pictures with the forces `later` steps afterwards.
fn correlation_at(streams: &[Vec<Instant>], later: i64) -> f64 {
    let shift = usize::try_from(later.unsigned_abs()).unwrap_or(usize::MAX);
    let shifted = || {
        streams.iter().flat_map(move |stream| {
            let behind = stream.get(shift..).unwrap_or(&[]);
            let before = &stream[..behind.len()];
            match later >= 0 {
                true => before.iter().zip(behind),
                false => behind.iter().zip(before),
            }
        })
    };
    correlation(
        shifted().map(|((_, light, _), _)| *light),
        shifted().map(|(_, (_, _, force))| *force),
    )
    .abs()
}

/// Lag with the best correlation of forces and pictures.
#[derive(Debug)]
struct Lag {
    /// Number of samples by which the force lags behind the picture.
    steps: i64,
    seconds: f64,
    /// Absolute correlation at the lag. `standing` is the correlation without a lag.
    best: f64,
    standing: f64,
}

/// Time, s; change or brightness of the picture; and absolute load.
type Instant = (f64, f64, f64);

/// Streams of each sensor unit, with the means of the unit subtracted, because units may differ in brightness.
fn alike(streams: BTreeMap<(Option<&str>, Option<&str>), Vec<Instant>>) -> Vec<Vec<Instant>> {
    let mut sums: BTreeMap<Option<&str>, [f64; 3]> = BTreeMap::new();
    for ((unit, _), stream) in &streams {
        let sum = sums.entry(*unit).or_default();
        for (_, light, force) in stream {
            *sum = [sum[0] + 1.0, sum[1] + light, sum[2] + force];
        }
    }
    // With one unit the values stay the same, bit for bit.
    let is_one = sums.len() == 1;
    let less = |unit: Option<&str>| match sums.get(&unit) {
        Some([count, light, force]) if !is_one => [light / count, force / count],
        _ => [0.0; 2],
    };
    let streams = streams.into_iter().map(|((unit, _), stream)| {
        let [light_mean, force_mean] = less(unit);
        let stream = stream.into_iter();
        stream
            .map(|(time, light, force)| (time, light - light_mean, force - force_mean))
            .collect()
    });
    streams.collect()
}

impl Lag {
    /// Common lag of all streams; `None` for too few samples, or if the steps are too long for a stream.
    fn of(streams: &[Vec<Instant>]) -> Option<Lag> {
        let pairs = streams.iter().flat_map(|stream| stream.windows(2));
        let mut steps: Vec<f64> = pairs.map(|pair| pair[1].0 - pair[0].0).collect();
        steps.retain(|step| *step > 0.0);
        steps.sort_by(f64::total_cmp);
        let step = *steps.get(steps.len() / 2)?;
        let count: usize = streams.iter().map(Vec::len).sum();
        if count < LEAST || step > STREAM_S {
            return None;
        }
        let at = |later| correlation_at(streams, later);
        let spans = streams
            .iter()
            .filter_map(|stream| Some(stream.last()?.0 - stream.first()?.0));
        let longest = OF_RECORDING * spans.sum::<f64>();
        // Limit of the lag: three quarters of the samples must have a partner.
        let furthest = (1..=FURTHEST).take_while(|shift| {
            let is_near = *shift as f64 * step <= longest;
            let partners = streams
                .iter()
                .map(|stream| stream.len().saturating_sub(*shift));
            is_near && (count - partners.sum::<usize>()) * SHARE <= count
        });
        let furthest = i64::try_from(furthest.count()).ok()?;
        // On a tie the smallest lag wins.
        let mut lags: Vec<i64> = (-furthest..=furthest).collect();
        lags.sort_by_key(|lag| lag.abs());
        let mut best = (0, at(0));
        for lag in lags {
            let found = at(lag);
            if found > best.1 {
                best = (lag, found);
            }
        }
        let seconds = best.0 as f64 * step;
        Some(Lag {
            steps: best.0,
            seconds,
            best: best.1,
            standing: at(0),
        })
    }

    /// True if the lag is clear in most parts of the recording with a varying force.
    fn holds_in_parts(&self, streams: &[Vec<Instant>]) -> bool {
        let part = |number: usize| -> Vec<Vec<Instant>> {
            let part = streams.iter().map(|stream| {
                let end = |parts: usize| stream.len() * parts / PARTS;
                stream[end(number)..end(number + 1)].to_vec()
            });
            part.collect()
        };
        let parts: Vec<Vec<Vec<Instant>>> = (0..PARTS).map(part).collect();
        let variances: Vec<f64> = parts.iter().map(|part| variance_of_forces(part)).collect();
        let greatest = variances.iter().copied().fold(0.0, f64::max);
        let parts = parts.iter().zip(variances);
        let loaded = parts.filter(|(_, variance)| *variance > LOADED * greatest);
        let loaded: Vec<bool> = loaded
            .map(|(part, _)| is_clear(correlation_at(part, self.steps), correlation_at(part, 0)))
            .collect();
        2 * loaded.iter().filter(|holds| **holds).count() > loaded.len()
    }
}

/// Variance of the forces of all `streams` together; 0 without forces.
fn variance_of_forces(streams: &[Vec<Instant>]) -> f64 {
    let forces = || streams.iter().flatten().map(|(_, _, force)| *force);
    let count = forces().count().max(1) as f64;
    let mean = forces().sum::<f64>() / count;
    forces().map(|force| (force - mean).powi(2)).sum::<f64>() / count
}

/// Pearson's correlation; 0 if a series is constant.
pub(super) fn correlation(
    first: impl Iterator<Item = f64> + Clone,
    second: impl Iterator<Item = f64> + Clone,
) -> f64 {
    let count = first.clone().count() as f64;
    let mean = [
        first.clone().sum::<f64>() / count,
        second.clone().sum::<f64>() / count,
    ];
    let (mut both, mut one, mut other) = (0.0, 0.0, 0.0);
    for (first, second) in first.zip(second) {
        let (first, second) = (first - mean[0], second - mean[1]);
        both += first * second;
        one += first * first;
        other += second * second;
    }
    // Rounding residue of a constant series is not a variation.
    let varies = |squares: f64, mean: f64| squares > VARIES * count * mean * mean;
    match varies(one, mean[0]) && varies(other, mean[1]) {
        true => both / (one * other).sqrt(),
        false => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Presses of different depths at thirty samples per second, with forces `later` steps after the pictures.
    fn presses(later: usize) -> Vec<(f64, f64, f64)> {
        let press = |number: usize| -> f64 {
            let (within, which) = (number % 40, number / 40);
            let depth = 0.3 + 0.17 * (which * 7 % 5) as f64;
            depth * (1.0 - ((within as f64 - 20.0) / 20.0).abs())
        };
        (later..400)
            .map(|number| {
                (
                    number as f64 / 30.0,
                    0.02 * press(number),
                    4.0 * press(number - later),
                )
            })
            .collect()
    }

    #[test]
    fn the_lag_of_a_clock_is_found_in_steps_with_its_sign() {
        for later in [0, 1, 5, 12] {
            let lag = Lag::of(&[presses(later)]).expect("a stream");
            assert_eq!(lag.steps, later as i64);
            assert!(lag.best > 0.99, "{lag:?}");
        }
        let earlier: Vec<(f64, f64, f64)> = presses(5)
            .into_iter()
            .rev()
            .enumerate()
            .map(|(number, (_, light, force))| (number as f64 / 30.0, light, force))
            .collect();
        assert_eq!(Lag::of(&[earlier]).expect("a stream").steps, -5);
    }

    #[test]
    fn a_lag_of_short_streams_is_found_in_all_of_them_together() {
        let all = presses(5);
        let streams: Vec<Vec<Instant>> = all.chunks(45).map(<[_]>::to_vec).collect();
        let lag = Lag::of(&streams).expect("streams");
        assert_eq!(lag.steps, 5);
        assert!(lag.best > 0.99, "{lag:?}");
    }

    #[test]
    fn a_lag_of_one_part_alone_does_not_hold_in_the_parts() {
        let lag = Lag::of(&[presses(5)]).expect("a stream");
        assert!(lag.holds_in_parts(&[presses(5)]));
        // One part alone is late.
        let mut one = presses(0);
        one[..130].clone_from_slice(&presses(5)[..130]);
        assert!(!lag.holds_in_parts(&[one]));
    }

    #[test]
    fn a_recording_that_is_pressed_in_its_middle_third_alone_has_its_lag() {
        let mut middle = presses(5);
        for (number, (_, light, force)) in middle.iter_mut().enumerate() {
            if !(155..235).contains(&number) {
                *light = 0.001;
            }
            if !(160..240).contains(&number) {
                *force = 0.01 * (number % 2) as f64;
            }
        }
        let streams = [middle];
        let lag = Lag::of(&streams).expect("a stream");
        assert_eq!(lag.steps, 5);
        assert!(lag.holds_in_parts(&streams), "{lag:?}");
    }

    #[test]
    fn what_is_no_stream_or_does_not_vary_has_no_lag() {
        assert!(Lag::of(&[presses(5)[..40].to_vec()]).is_none());
        let slow: Vec<_> = presses(5)
            .into_iter()
            .map(|(time, light, force)| (60.0 * time, light, force))
            .collect();
        assert!(Lag::of(&[slow]).is_none());
        let still: Vec<_> = presses(5)
            .into_iter()
            .map(|(time, _, force)| (time, 0.1, force))
            .collect();
        assert_eq!(Lag::of(&[still]).expect("a stream").steps, 0);
    }
}
