//! TAC023: frames missing from a stream, detected by gaps between time stamps.

use taceva_core::by_count;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use crate::stamps::{Step, Stream, share};

pub(super) static CHECK: Check = Check {
    code: "TAC023",
    name: "dropped-frames",
    looks_for: "missing frames in a stream of constant rate: steps of two to ten periods",
    hint: "record to a faster disk, or record fewer streams at once; give joins by time a tolerance below the usual step",
    reads: None,
    find,
};

/// Time steps between frames that count as gaps, in frame periods. Longer steps are pauses.
const GAP: std::ops::Range<f64> = 1.5..10.5;
/// Maximum relative deviation of a step from the median step in a regular stream. `REGULAR` is the minimum fraction of steps within this deviation.
const NEAR: f64 = 0.25;
const REGULAR: f64 = 0.75;
/// In streams with many missing frames, the period is searched near the quantile 1 / `SHORT` of the steps.
const SHORT: usize = 10;
/// Minimum fraction of steps that are one period long, in a stream with many missing frames.
const SINGLE: f64 = 0.3;
/// Maximum deviation of a step from a multiple of the period, in periods. `MULTIPLES` is the minimum fraction of steps within this deviation.
const WHOLE: f64 = 0.2;
const MULTIPLES: f64 = 0.9;
/// Resolutions to which time stamps are truncated, s. For example, a steady stream of 60 Hz in hundredths of a second has steps of one and two hundredths.
const PLACES: [f64; 4] = [1.0, 0.1, 0.01, 0.001];
/// Maximum relative deviation of a period from a resolution in `PLACES`. `STRAY` is the maximum drift of truncated time stamps from a constant
/// period, in periods.
const AT_PLACE: f64 = 0.01;
const STRAY: f64 = 2.0;
/// Fraction of missing frames above which the finding is a warning.
const WARN: f64 = 0.01;

/// Missing frames of a stream.
#[derive(Debug)]
pub(super) struct Missing {
    /// Number of missing frames, a whole number.
    pub(super) frames: f64,
    /// First row after each gap.
    rows: Vec<usize>,
    /// Number of steps of the stream.
    steps: usize,
    /// Longest gap, in periods.
    longest: f64,
    period_s: f64,
}

impl Missing {
    /// Missing frames of `stream`; `None` if no frame is missing or no period is found.
    fn of(stream: &Stream) -> Option<Missing> {
        let period_s = period(stream)?;
        let periods = |step: &Step| step.seconds / period_s;
        let mut missing = Missing {
            frames: 0.0,
            rows: Vec::new(),
            steps: stream.steps.len(),
            longest: 0.0,
            period_s,
        };
        // Excludes steps of one period, pauses, and clocks that were set back.
        let is_between = |step: &Step| {
            let periods = periods(step);
            periods > -0.5 && periods < GAP.end && !(0.5..GAP.start).contains(&periods)
        };
        for run in stream.runs() {
            for steps in run.split(|step| !is_between(step)) {
                // A late or doubled stamp makes one step too short and the next too long, without a missing frame.
                let frames: f64 = steps.iter().map(|step| periods(step).round() - 1.0).sum();
                if frames < 0.5 {
                    continue;
                }
                missing.frames += frames;
                for step in steps.iter().filter(|step| periods(step) >= GAP.start) {
                    missing.rows.push(step.to);
                    missing.longest = missing.longest.max(periods(step).round());
                }
            }
        }
        missing.rows.sort_unstable();
        (!missing.rows.is_empty()).then_some(missing)
    }
}

/// Missing frames in the stream of a recording.
pub(super) fn missing(evidence: &Evidence<'_>) -> Option<Missing> {
    Missing::of(&Stream::of(evidence)?)
}

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let Some(missing) = missing(evidence) else {
        return Vec::new();
    };
    let severity = match missing.frames >= WARN * share(evidence.table.rows(), 1) {
        true => Severity::Warning,
        false => Severity::Note,
    };
    let frames = match missing.frames < 1.5 {
        true => "frame seems",
        false => "frames seem",
    };
    let up_to = by_count(missing.rows.len(), "is", "are up to");
    let message = format!(
        "{} {frames} to be missing in {} of {} steps, which {up_to} {:.0} times the period of {:.4} s",
        missing.frames,
        missing.rows.len(),
        missing.steps,
        missing.longest,
        missing.period_s
    );
    vec![evidence.found(severity, message, &missing.rows)]
}

/// Period of the frames, s; `None` if the steps are irregular.
fn period(stream: &Stream) -> Option<f64> {
    let of = |is_so: &dyn Fn(f64) -> bool, unit: f64| {
        let steps = stream.steps.iter();
        let counted = steps.filter(|step| is_so(step.seconds / unit)).count();
        share(counted, stream.steps.len())
    };
    let is_near = |steps: f64| (steps - 1.0).abs() <= NEAR;
    if of(&is_near, stream.usual_s) >= REGULAR {
        return Some(stream.usual_s);
    }
    let mut forward: Vec<f64> = stream.steps.iter().map(|step| step.seconds).collect();
    forward.retain(|seconds| *seconds > 0.0);
    forward.sort_by(f64::total_cmp);
    let short = *forward.get(forward.len() / SHORT)?;
    forward.retain(|seconds| is_near(seconds / short));
    let period = *forward.get(forward.len() / 2)?;
    let is_single = |periods: f64| (periods - 1.0).abs() <= WHOLE;
    let is_multiple = |periods: f64| {
        (0.5..GAP.end).contains(&periods) && (periods - periods.round()).abs() <= WHOLE
    };
    let is_period = of(&is_single, period) >= SINGLE && of(&is_multiple, period) >= MULTIPLES;
    (is_period && !is_cut(stream, period)).then_some(period)
}

/// True if the steps fit a constant period, with time stamps truncated to a decimal place near `period`.
fn is_cut(stream: &Stream, period: f64) -> bool {
    let is_pause = |step: &Step| step.seconds / period >= GAP.end;
    let steps = stream.steps.iter().filter(|step| !is_pause(step));
    let count = share(steps.clone().count(), 1);
    let pace = steps.map(|step| step.seconds / period).sum::<f64>() / count;
    let strays = |steps: &[Step]| {
        let (mut off, mut least, mut most) = (0.0, 0.0_f64, 0.0_f64);
        for step in steps {
            off += step.seconds / period - pace;
            (least, most) = (least.min(off), most.max(off));
        }
        most - least > STRAY
    };
    PLACES
        .iter()
        .any(|place| (period / place - 1.0).abs() <= AT_PLACE)
        && stream
            .runs()
            .iter()
            .all(|run| !run.split(is_pause).any(strays))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Number of missing frames in a stream whose steps are `periods` times 1/30 s.
    fn missing_of(periods: &[f64]) -> f64 {
        let seconds: Vec<f64> = periods.iter().map(|periods| periods / 30.0).collect();
        Missing::of(&Stream::of_seconds(&seconds)).map_or(0.0, |missing| missing.frames)
    }

    #[track_caller]
    fn same(found: f64, expected: f64) {
        assert!((found - expected).abs() < 0.5, "{found}, not {expected}");
    }

    #[test]
    fn every_other_third_and_fourth_frame_that_is_missing_is_counted() {
        same(missing_of(&[1.0, 1.0, 1.0, 2.0].repeat(20)), 20.0);
        same(missing_of(&[1.0, 1.0, 2.0].repeat(20)), 20.0);
        same(missing_of(&[1.0, 2.0].repeat(20)), 20.0);
        // Two of three steps are longer than the period, which is then not the median.
        same(missing_of(&[1.0, 2.0, 3.0].repeat(20)), 60.0);
        same(missing_of(&[1.04, 1.93, 0.97, 3.06].repeat(20)), 60.0);
    }

    #[test]
    fn steps_that_are_no_whole_multiples_of_one_miss_no_frame() {
        same(missing_of(&[0.6, 1.4].repeat(20)), 0.0);
        same(missing_of(&[0.2, 0.46].repeat(20)), 0.0);
        same(
            missing_of(&[1.0, 1.6, 0.7, 2.4, 1.3, 3.5, 0.8].repeat(20)),
            0.0,
        );
        same(missing_of(&[1.0, 5.0, 30.0, 2.0, 80.0].repeat(20)), 0.0);
    }

    #[test]
    fn a_stamp_that_is_doubled_or_late_misses_no_frame() {
        let mut steps = vec![1.0; 60];
        (steps[20], steps[21]) = (0.0, 2.0);
        (steps[40], steps[41]) = (1.7, 0.3);
        (steps[50], steps[51], steps[52]) = (3.0, 0.0, 0.0);
        same(missing_of(&steps), 0.0);
        (steps[21], steps[30]) = (3.0, 2.0);
        same(missing_of(&steps), 2.0);
    }

    #[test]
    fn an_even_pace_in_hundredths_of_a_second_misses_no_frame() {
        let stamps = |number: u32| (f64::from(number) / 0.6).floor() / 100.0;
        let steps: Vec<f64> = (0..200)
            .map(|number| stamps(number + 1) - stamps(number))
            .collect();
        assert!(Missing::of(&Stream::of_seconds(&steps)).is_none());
        // Frames missing at random drift further.
        let steps: Vec<f64> = (0..200)
            .map(|number| match number % 100 {
                0..50 => 0.01,
                _ => 0.02,
            })
            .collect();
        let missing = Missing::of(&Stream::of_seconds(&steps)).expect("100 are missing");
        same(missing.frames, 100.0);
    }
}
