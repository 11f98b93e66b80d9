//! TAC023: frames of a stream that should have come, by the gaps between the stamps of others.

use super::evidence::Evidence;
use super::finding::{Check, Found, Severity};
use super::stream::Stream;

pub(super) static CHECK: Check = Check {
    code: "TAC023",
    name: "dropped-frames",
    looks_for: "steps of a regular stream that are two to ten usual ones: frames between them are missing",
    hint: "record to a faster disk or fewer streams at once; joins by time should have a tolerance below the usual step",
    reads: None,
    find,
};

/// Steps of so many usual ones are gaps; longer ones are pauses.
const GAP: std::ops::Range<f64> = 1.5..10.5;
/// How far a step of a regular stream is from the usual one, and how many of the steps are so near.
const NEAR: f64 = 0.25;
const REGULAR: f64 = 0.75;
/// The share of missing frames from which a warning is due.
const WARN: f64 = 0.01;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let Some(stream) = Stream::of(evidence) else {
        return Vec::new();
    };
    let of_usual = |seconds: f64| seconds / stream.usual_s;
    let near = stream.steps.iter();
    let near = near.filter(|step| (of_usual(step.seconds) - 1.0).abs() <= NEAR);
    if share(near.count(), stream.steps.len()) < REGULAR {
        return Vec::new();
    }
    let gaps = stream.steps.iter();
    let gaps: Vec<(usize, f64)> = gaps
        .filter(|step| GAP.contains(&of_usual(step.seconds)))
        .map(|step| (step.to, of_usual(step.seconds).round() - 1.0))
        .collect();
    let missing: f64 = gaps.iter().map(|(_, missing)| missing).sum();
    let rows: Vec<usize> = gaps.iter().map(|(row, _)| *row).collect();
    if rows.is_empty() {
        return Vec::new();
    }
    let severity = match missing >= WARN * share(evidence.table.rows(), 1) {
        true => Severity::Warning,
        false => Severity::Note,
    };
    let message = format!(
        "{missing} frames seem to be missing before {} of {} steps, which are up to {:.0} times the usual one of {:.4} s",
        rows.len(),
        stream.steps.len(),
        gaps.iter()
            .fold(0.0, |most: f64, (_, missing)| most.max(missing + 1.0)),
        stream.usual_s
    );
    vec![Found::about(severity, message, evidence.names(&rows))]
}

#[expect(clippy::cast_precision_loss, reason = "rows are far below 2^53")]
fn share(part: usize, whole: usize) -> f64 {
    part as f64 / whole.max(1) as f64
}
