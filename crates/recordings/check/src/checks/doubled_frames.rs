//! TAC022: stream frames that repeat the previous frame.

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use crate::stamps::Stream;

pub(super) static CHECK: Check = Check {
    code: "TAC022",
    name: "doubled-frames",
    looks_for: "frames of a stream that repeat the previous frame, and rows that share one frame",
    hint: "a camera slower than its stamps repeats frames: use the stamps of the camera, or keep one row per frame; labels of repeats are \
        not independent",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let Some(stream) = Stream::of(evidence) else {
        return Vec::new();
    };
    let (frames, sources) = (evidence.table.frames(), evidence.table.source_frame());
    let digest = |row: usize| frames[row].as_ref().map(|frame| frame.digest);
    let (mut doubled, mut shared) = (Vec::new(), Vec::new());
    let mut longest = 1;
    // The stream pauses between presses, which ends a run.
    for run in stream.runs() {
        let mut alike = 1;
        for step in run {
            let (before, row) = (step.from, step.to);
            if digest(row).is_none() || digest(row) != digest(before) {
                alike = 1;
            } else if sources[row].is_some() && sources[row] == sources[before] {
                shared.push(row);
            } else {
                alike += 1;
                longest = longest.max(alike);
                doubled.push(row);
            }
        }
    }
    doubled.sort_unstable();
    shared.sort_unstable();
    let of = |rows: &[usize], severity, message: String| {
        (!rows.is_empty()).then(|| evidence.found(severity, message, rows))
    };
    let steps = stream.steps.len();
    let repeats = format!(
        "{} of {steps} steps repeat the previous frame, up to {longest} in a row: the stamps are at {:.4} Hz, new pictures at {:.4} Hz",
        doubled.len(),
        1.0 / stream.usual_s,
        rate(steps - doubled.len(), steps) / stream.usual_s
    );
    let together = format!(
        "{} of {steps} rows have the frame of the previous row: labels are faster than frames",
        shared.len()
    );
    let found = [
        of(&doubled, Severity::Warning, repeats),
        of(&shared, Severity::Note, together),
    ];
    found.into_iter().flatten().collect()
}

fn rate(part: usize, whole: usize) -> f64 {
    part as f64 / whole.max(1) as f64
}
