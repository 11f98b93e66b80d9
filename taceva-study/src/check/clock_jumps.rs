//! TAC024: clocks that jump, and stamps of two clocks in one column.

use taceva_core::Clock;

use super::evidence::Evidence;
use super::finding::{Check, Found, Severity};
use super::stream::Stream;

pub(super) static CHECK: Check = Check {
    code: "TAC024",
    name: "clock-jumps",
    looks_for: "a clock that was set within a contact, stamps of two clocks in one column, and times that the stated clock cannot show",
    hint: "stamp with a clock that nobody sets (monotonic), and import what two clocks stamped as two tables joined with their lag",
    reads: None,
    find,
};

/// So many usual steps within one contact, and at least so many seconds, are a jump.
const JUMP_STEPS: f64 = 100.0;
const JUMP_S: f64 = 1.0;
/// No recording goes on for so long between two rows, s: twelve days. Seconds since 1970 and since a start are 54 years apart.
const TWO_CLOCKS_S: f64 = 1e6;
/// Seconds since 1970 at which Unix times of recordings begin (1990), and beyond which no machine has been running (32 years).
const UNIX_FROM_S: f64 = 631_152_000.0;
/// Seconds since 1970 at which they end (2100).
const UNIX_TO_S: f64 = 4_102_444_800.0;
const RUNNING_S: f64 = 1e9;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let times = evidence.table.t_s();
    let rows = times.iter().enumerate();
    let known: Vec<(usize, f64)> = rows
        .filter_map(|(row, time)| Some((row, (*time)?)))
        .collect();
    let others: Vec<usize> = known
        .windows(2)
        .filter(|pair| (pair[1].1 - pair[0].1).abs() > TWO_CLOCKS_S)
        .map(|pair| pair[1].0)
        .collect();
    let mut found = Vec::new();
    if let Some(row) = others.first() {
        let before = known.iter().rfind(|(known, _)| known < row);
        let message = format!(
            "two clocks stamped these samples: {} times the next stamp is more than 12 days away, first from {} s to {} s",
            others.len(),
            before.map_or(0.0, |(_, time)| *time),
            times[*row].unwrap_or_default()
        );
        found.push(Found::about(
            Severity::Warning,
            message,
            evidence.names(&others),
        ));
    }
    found.extend(set_within(evidence));
    found.extend(contradicted(evidence, &known));
    found
}

/// Stamps that jump ahead within one contact, by less than two clocks are apart.
fn set_within(evidence: &Evidence<'_>) -> Option<Found> {
    let stream = Stream::of(evidence)?;
    let jumps = stream.steps.iter().filter(|step| {
        step.seconds > JUMP_S
            && step.seconds > JUMP_STEPS * stream.usual_s
            && step.seconds <= TWO_CLOCKS_S
    });
    // Without contact points a pause between presses looks the same.
    let jumps = jumps.filter(|step| evidence.table.point_id()[step.to].is_some());
    let longest = jumps.clone().map(|step| step.seconds).reduce(f64::max)?;
    let rows: Vec<usize> = jumps.map(|step| step.to).collect();
    let message = format!(
        "{} steps within a contact are over {JUMP_STEPS} times the usual one of {:.4} s, the longest {longest:.3} s: the clock was set, or recording stopped",
        rows.len(),
        stream.usual_s
    );
    Some(Found::about(
        Severity::Warning,
        message,
        evidence.names(&rows),
    ))
}

/// What is stated of the clock, where the stamps cannot be its.
fn contradicted(evidence: &Evidence<'_>, known: &[(usize, f64)]) -> Option<Found> {
    let last = known.iter().map(|(_, time)| *time).reduce(f64::max)?;
    let message = match evidence.header.clock {
        Clock::Unix if last < UNIX_FROM_S => format!(
            "the clock is said to be `unix`, and the last stamp, {last} s, is before 1990: is its unit right?"
        ),
        Clock::Unix if last > UNIX_TO_S => format!(
            "the clock is said to be `unix`, and the last stamp, {last} s, is after 2100: is its unit right?"
        ),
        Clock::Monotonic if last > RUNNING_S => format!(
            "the clock is said to be `monotonic`, and the last stamp is {last} s: no machine has been running for so long"
        ),
        _ => return None,
    };
    Some(Found::overall(Severity::Warning, message))
}
