//! TAC019: labels that come later or earlier than their pictures, as by two clocks.

use taceva_core::Field;

use super::evidence::Evidence;
use super::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC019",
    name: "label-lag",
    looks_for: "forces that go with the pictures before or after theirs: two clocks that differ",
    hint: "state the difference as `lag_ms` of the join in the map, or shift one clock before the tables are joined",
    reads: Some(Field::Frame),
    find,
};

/// Samples of a stream below which a lag says nothing.
const LEAST: usize = 50;
/// The longest median step, in s, of samples that are a stream.
const STREAM_S: f64 = 1.0;
/// The furthest that is looked, in steps, and as a share of the samples.
const FURTHEST: usize = 60;
const SHARE: usize = 4;
/// How well pictures and forces must go together at the lag, as a correlation, and how many times less of the variance it leaves open there
/// than where they stand.
const CLEAR: f64 = 0.6;
const BETTER: f64 = 1.5;

/// A series varies if its variance is above this share of the square of its mean.
const VARIES: f64 = 1e-20;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let table = evidence.table;
    let Some(load) = evidence.load() else {
        return Vec::new();
    };
    let rows = evidence.frames.iter().enumerate();
    let series: Vec<(f64, f64, f64)> = rows
        .filter_map(|(row, facts)| {
            let facts = facts.as_ref()?;
            let light = facts
                .distance
                .unwrap_or(facts.mean.iter().sum::<f64>() / 3.0);
            Some((table.t_s()[row]?, light, table.truth(load).get(row)?.abs()))
        })
        .collect();
    let name = table.channels().as_slice()[load].name();
    let lag = Lag::of(&series);
    let found = lag.filter(|lag| {
        lag.steps != 0
            && lag.best >= CLEAR
            && 1.0 - lag.standing.powi(2) >= BETTER * (1.0 - lag.best.powi(2))
    });
    let message = found.map(|lag| {
        let (later, steps) = match lag.steps > 0 {
            true => ("later", lag.steps),
            false => ("earlier", -lag.steps),
        };
        format!(
            "{name} comes about {:.0} ms ({steps} {}) {later} than the pictures: their correlation is {:.2} there and {:.2} as they stand, n {}",
            1e3 * lag.seconds.abs(),
            if steps == 1 { "step" } else { "steps" },
            lag.best,
            lag.standing,
            series.len()
        )
    });
    message
        .into_iter()
        .map(|message| Found::overall(Severity::Warning, message))
        .collect()
}

/// Where forces and pictures go together best.
#[derive(Debug)]
struct Lag {
    /// How many samples later the force is.
    steps: i64,
    seconds: f64,
    /// The correlations there and without a lag, whatever their sign.
    best: f64,
    standing: f64,
}

impl Lag {
    /// The lag of a series of a time in s, a number of the picture and a force each; `None` if it is no stream.
    fn of(series: &[(f64, f64, f64)]) -> Option<Lag> {
        let mut steps: Vec<f64> = series
            .windows(2)
            .map(|pair| pair[1].0 - pair[0].0)
            .collect();
        steps.retain(|step| *step > 0.0);
        steps.sort_by(f64::total_cmp);
        let step = *steps.get(steps.len() / 2)?;
        if series.len() < LEAST || step > STREAM_S {
            return None;
        }
        let furthest = FURTHEST.min(series.len() / SHARE);
        let at = |later: i64| -> f64 {
            let shift = usize::try_from(later.unsigned_abs()).unwrap_or(usize::MAX);
            let (pictures, forces) = match later >= 0 {
                true => (&series[..series.len() - shift], &series[shift..]),
                false => (&series[shift..], &series[..series.len() - shift]),
            };
            correlation(
                pictures.iter().map(|(_, light, _)| *light),
                forces.iter().map(|(_, _, force)| *force),
            )
            .abs()
        };
        let furthest = i64::try_from(furthest).ok()?;
        // Of lags that are as good the nearest.
        let mut lags: Vec<i64> = (-furthest..=furthest).collect();
        lags.sort_by_key(|lag| lag.abs());
        let mut best = (0, at(0));
        for lag in lags {
            let found = at(lag);
            if found > best.1 {
                best = (lag, found);
            }
        }
        #[expect(clippy::cast_precision_loss, reason = "at most 60 steps")]
        let seconds = best.0 as f64 * step;
        Some(Lag {
            steps: best.0,
            seconds,
            best: best.1,
            standing: at(0),
        })
    }
}

/// Pearson's correlation; 0 where one of them does not vary.
fn correlation(
    first: impl Iterator<Item = f64> + Clone,
    second: impl Iterator<Item = f64> + Clone,
) -> f64 {
    #[expect(clippy::cast_precision_loss, reason = "counts of rows")]
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
    // What rounding leaves of a series that does not vary is no variation.
    let varies = |squares: f64, mean: f64| squares > VARIES * count * mean * mean;
    match varies(one, mean[0]) && varies(other, mean[1]) {
        true => both / (one * other).sqrt(),
        false => 0.0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Presses of different depths, thirty samples a second; forces `later` steps after their pictures.
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
            let lag = Lag::of(&presses(later)).expect("a stream");
            assert_eq!(lag.steps, later as i64);
            assert!(lag.best > 0.99, "{lag:?}");
        }
        let earlier: Vec<(f64, f64, f64)> = presses(5)
            .into_iter()
            .rev()
            .enumerate()
            .map(|(number, (_, light, force))| (number as f64 / 30.0, light, force))
            .collect();
        assert_eq!(Lag::of(&earlier).expect("a stream").steps, -5);
    }

    #[test]
    fn what_is_no_stream_or_does_not_vary_has_no_lag() {
        assert!(Lag::of(&presses(5)[..40]).is_none());
        let slow: Vec<_> = presses(5)
            .into_iter()
            .map(|(time, light, force)| (60.0 * time, light, force))
            .collect();
        assert!(Lag::of(&slow).is_none());
        let still: Vec<_> = presses(5)
            .into_iter()
            .map(|(time, _, force)| (time, 0.1, force))
            .collect();
        assert_eq!(Lag::of(&still).expect("a stream").steps, 0);
    }
}
