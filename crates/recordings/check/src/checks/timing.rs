//! TAC008: measured sample rate, and impossible times.

use taceva_core::by_count;
use taceva_dataset::Table;
use taceva_metrics::STREAM_S;

use super::dropped_frames::{Missing, missing};
use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use crate::stamps::{by_clock, by_time, is_of_presses, share};

pub(super) static CHECK: Check = Check {
    code: "TAC008",
    name: "timing",
    looks_for: "true frame rate of each unit, its gaps, and times that repeat, decrease or are whole seconds",
    hint: "stamp frames at their exposure with a monotonic clock, and keep the fractions of a second",
    reads: None,
    find,
};

/// Remedy for a recording made by this program, whose devices and drivers stamped the frames.
const OF_RECORDING: &str = "the device or its driver stamped these frames: check it with `taceva rig check`, end other programs on this machine, \
    and record again";

/// Minimum number of samples for computing a rate.
const LEAST: usize = 10;
/// Length above which a step is a gap, in median steps, including a tolerance for rounding.
const GAP: f64 = 3.0;
const ROUNDING: f64 = 1e-6;
/// Maximum relative difference, in a regular stream, between the median step and the mean of the steps without gaps.
const ALIKE: f64 = 0.05;

/// Last words of the message about a sample rate without gaps, which needs no fix.
const WITHOUT_GAPS: &str = ", without gaps";

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let table = evidence.table;
    let times = table.t_s();
    let timed: Vec<usize> = (0..table.rows())
        .filter(|row| times[*row].is_some())
        .collect();
    if timed.len() < LEAST {
        return Vec::new();
    }
    // Another unit of the sensor is another recording with its own clock.
    let mut pairs = by_clock(table, timed.iter().copied());
    let is_of_one_clock = !pairs.is_empty();
    if !is_of_one_clock {
        // Files with one row each have only the order of their times, and each may have its own clock.
        pairs = by_time(table, &timed);
    }
    if starts_anew(table, &pairs) {
        let points = table.point_id();
        pairs.retain(|(before, row)| points[*before] == points[*row]);
    }
    let steps: Vec<(usize, f64)> = pairs
        .into_iter()
        .filter_map(|(before, row)| Some((row, times[row]? - times[before]?)))
        .collect();
    let mut found = Vec::new();
    // There is no rate between presses.
    if !is_of_presses(evidence) && !steps.is_empty() {
        let rate = rate(&steps, missing(evidence).as_ref());
        let is_whole = rate.message.ends_with(WITHOUT_GAPS);
        found.push(match evidence.is_recording() && is_whole {
            true => rate.without_hint(),
            false => rate,
        });
    }
    let rows_of = |is_so: fn(f64) -> bool| -> Vec<usize> {
        let steps = steps.iter().filter(|(_, seconds)| is_so(*seconds));
        steps.map(|(row, _)| *row).collect()
    };
    let backwards = rows_of(|seconds| seconds < 0.0);
    let repeated = rows_of(|seconds| seconds.abs() <= 0.0);
    let whole = times.iter().flatten().all(|time| time.fract().abs() <= 0.0);
    let warn = |message: &str, rows: &[usize]| {
        evidence.found(
            Severity::Warning,
            match rows.len() {
                1 => format!(
                    "1 {}",
                    message.replacen("samples are", "sample is", 1).replacen(
                        "samples have",
                        "sample has",
                        1
                    )
                ),
                many => format!("{many} {message}"),
            },
            rows,
        )
    };
    if let Some(sessions) = evidence.sessions {
        found.push(Found::overall(Severity::Note, sessions.note.clone()).without_hint());
    }
    // The clock of a machine restarts with every boot.
    let boots = evidence.sessions.map_or(1, |sessions| sessions.boots);
    if backwards.len() >= boots {
        found.push(warn(
            "samples are older than the previous sample",
            &backwards,
        ));
    }
    if is_of_one_clock && !repeated.is_empty() {
        found.push(warn(
            "samples have the same time as the previous sample",
            &repeated,
        ));
    }
    if whole {
        found.push(Found::overall(
            Severity::Warning,
            "every time is a whole second".to_owned(),
        ));
    }
    if evidence.is_recording() {
        let of_recording = |found: Found| match found.hint {
            None => found.with_hint(OF_RECORDING),
            Some(_) => found,
        };
        found = found.into_iter().map(of_recording).collect();
    }
    found
}

/// True if the times restart at every contact point, as in a recording of episodes. A clock that was set back once restarts at one contact point
/// only.
fn starts_anew(table: &Table, pairs: &[(usize, usize)]) -> bool {
    let times = table.t_s();
    let points = table.point_id();
    let mut changes = 0;
    for (before, row) in pairs.iter().copied() {
        if points[before] == points[row] {
            continue;
        }
        if times[row] >= times[before] {
            return false;
        }
        changes += 1;
    }
    // Points of one row each show nothing: rows may be in any order.
    changes > 0 && pairs.len() >= 2 * changes
}

/// Finding about the sample rate, computed from the median of the forward steps. Pauses between presses therefore do not affect the rate.
fn rate(steps: &[(usize, f64)], missing: Option<&Missing>) -> Found {
    let mut forward: Vec<f64> = steps.iter().map(|(_, seconds)| *seconds).collect();
    forward.retain(|seconds| *seconds > 0.0);
    forward.sort_by(f64::total_cmp);
    let Some(&usual) = forward.get(forward.len() / 2) else {
        return Found::overall(
            Severity::Note,
            "times never increase from sample to sample".to_owned(),
        );
    };
    if usual > STREAM_S {
        return Found::overall(
            Severity::Note,
            format!(
                "single pictures, not a stream: the median step is {usual:.4} s, above {STREAM_S} s, so a frame rate is not defined"
            ),
        )
        .without_hint();
    }
    let is_gap = |seconds: f64| seconds > GAP * usual * (1.0 + ROUNDING);
    let gaps = forward.iter().filter(|step| is_gap(**step)).count();
    let longest = forward.last().copied().unwrap_or(usual);
    let others = steps.iter().map(|(_, seconds)| *seconds);
    let others: Vec<f64> = others
        .filter(|step| *step >= 0.0 && !is_gap(*step))
        .collect();
    let mean = others.iter().sum::<f64>() / share(others.len(), 1);
    let is_alike = (mean / usual - 1.0).abs() <= ALIKE;
    let mut message = format!("{:.4} Hz from the median step of {usual:.4} s", 1.0 / usual);
    if !is_alike {
        message += &format!(", {:.4} Hz from the mean step of {mean:.4} s", 1.0 / mean);
    }
    if gaps > 0 {
        let steps_are = by_count(gaps, "step is", "steps are");
        message += &format!(
            "; {gaps} {steps_are} over {GAP} times the median, the longest {longest:.4} s"
        );
    }
    if let Some(missing) = missing {
        let frames = missing.frames;
        let frames_seem = match frames < 1.5 {
            true => "frame seems",
            false => "frames seem",
        };
        message += &format!("; {frames} {frames_seem} to be missing");
    }
    if is_alike && gaps == 0 && missing.is_none() {
        message += WITHOUT_GAPS;
    }
    Found::overall(Severity::Note, message)
}
