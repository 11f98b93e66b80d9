//! TAC008: the true rate, and times that cannot be.

use super::evidence::Evidence;
use super::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC008",
    name: "timing",
    looks_for: "the true frame rate, its gaps, and times that repeat, run backwards or are whole seconds",
    hint: "stamp frames when they are exposed, with a clock that does not jump, and keep the fractions of a second",
    reads: None,
    find,
};

/// Samples below which a rate says nothing.
const LEAST: usize = 10;
/// The longest median step, in s, of frames that are a stream; the metric `intrinsic` has the same limit.
const STREAM_S: f64 = 1.0;
/// A step of so many usual steps is a gap.
const GAP: f64 = 3.0;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let rows = evidence.table.t_s().iter().enumerate();
    let times: Vec<(usize, f64)> = rows
        .filter_map(|(row, time)| Some((row, (*time)?)))
        .collect();
    if times.len() < LEAST {
        return Vec::new();
    }
    let units = evidence.table.unit_id();
    let mut found = vec![rate(&times)];
    let backwards: Vec<usize> = times
        .windows(2)
        .filter(|pair| pair[1].1 < pair[0].1)
        // Another unit of the sensor is another recording, whose clock begins anew.
        .filter(|pair| units[pair[1].0] == units[pair[0].0])
        .map(|pair| pair[1].0)
        .collect();
    let repeated: Vec<usize> = times
        .windows(2)
        .filter(|pair| pair[1].1.to_bits() == pair[0].1.to_bits())
        .map(|pair| pair[1].0)
        .collect();
    let whole = times.iter().all(|(_, time)| time.fract().abs() <= 0.0);
    let warn = |message: &str, rows: &[usize]| {
        Found::about(
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
            evidence.names(rows),
        )
    };
    if let Some(sessions) = evidence.sessions {
        found.push(Found::overall(Severity::Note, sessions.note.clone()));
    }
    // The clock of a machine begins anew with every boot.
    let boots = evidence.sessions.map_or(1, |sessions| sessions.boots);
    if backwards.len() >= boots {
        found.push(warn(
            "samples are older than the one before them",
            &backwards,
        ));
    }
    if !repeated.is_empty() {
        found.push(warn(
            "samples have the time of the one before them",
            &repeated,
        ));
    }
    if whole {
        found.push(Found::overall(
            Severity::Warning,
            "every time is a whole second".to_owned(),
        ));
    }
    found
}

/// The usual step is the median of the forward steps: pauses between presses do not move it.
fn rate(times: &[(usize, f64)]) -> Found {
    let mut steps: Vec<f64> = times
        .windows(2)
        .map(|pair| pair[1].1 - pair[0].1)
        .filter(|step| *step > 0.0)
        .collect();
    steps.sort_by(f64::total_cmp);
    let Some(&usual) = steps.get(steps.len() / 2) else {
        return Found::overall(
            Severity::Note,
            "no two samples have rising times".to_owned(),
        );
    };
    if usual > STREAM_S {
        return Found::overall(
            Severity::Note,
            format!(
                "single pictures and no stream: the median step is {usual:.4} s, above {STREAM_S} s, so that there is no frame rate"
            ),
        );
    }
    let gaps = steps.iter().filter(|step| **step > GAP * usual).count();
    let longest = steps.last().copied().unwrap_or(usual);
    if gaps == 0 {
        let message = format!(
            "{:.4} Hz by the median step of {usual:.4} s, without gaps",
            1.0 / usual
        );
        return Found::overall(Severity::Note, message);
    }
    let message = format!(
        "{:.4} Hz by the median step of {usual:.4} s; {gaps} steps are over {GAP} times that, the longest {longest:.4} s",
        1.0 / usual
    );
    Found::overall(Severity::Note, message)
}
