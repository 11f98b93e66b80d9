//! TAC024: clocks that jump, and time stamps of two clocks in one column.

use std::collections::BTreeMap;

use taceva_core::{Clock, by_count, counted};
use taceva_dataset::Table;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use crate::stamps::{Step, Stream, by_clock};

pub(super) static CHECK: Check = Check {
    code: "TAC024",
    name: "clock-jumps",
    looks_for: "a clock that was set during a contact (without contact points: within a regular stream), local times at the end of summer time, two clocks in one column, and impossible times",
    hint: "stamp with a monotonic clock; import data of two clocks as two tables, joined with their lag",
    reads: None,
    find,
};

/// Minimum jump of a clock, as a multiple of the median step between samples. A jump must also exceed `JUMP_S`, s.
const JUMP_STEPS: f64 = 100.0;
const JUMP_S: f64 = 1.0;
/// Maximum frequency of jumps in recordings without contact points: a single jump, or one in this many steps. More frequent jumps are pauses between
/// presses.
const SELDOM: usize = 100;
/// Maximum 90th percentile of the steps of a regular stream, as a multiple of the median step. Recordings without contact points are searched for
/// jumps only if they are regular streams.
const REGULAR_STEPS: f64 = 3.0;
/// Difference between consecutive time stamps that indicates two clocks, s: twelve days. A Unix clock and an uptime clock are 54 years apart.
const TWO_CLOCKS_S: f64 = 1e6;
/// Earliest plausible Unix time of a recording (1990), s. `RUNNING_S` is the maximum plausible uptime (32 years), s.
const UNIX_FROM_S: f64 = 631_152_000.0;
/// Latest plausible Unix time of a recording (2100), s.
const UNIX_TO_S: f64 = 4_102_444_800.0;
const RUNNING_S: f64 = 1e9;
/// Time by which a local clock is set back at the end of summer time, s. `NEAR_S` is the tolerance for the step of the stream, s.
const SUMMER_TIME_S: f64 = 3_600.0;
const NEAR_S: f64 = 60.0;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let table = evidence.table;
    let times = table.t_s();
    let timed = (0..table.rows()).filter(|row| times[*row].is_some());
    // Another unit of the sensor, or another table, may be from another month.
    let seconds = |row: usize| times[row].unwrap_or_default();
    let mut others = by_clock(table, timed);
    others.retain(|(before, row)| (seconds(*row) - seconds(*before)).abs() > TWO_CLOCKS_S);
    let mut found = Vec::new();
    if let Some((before, row)) = others.first() {
        let message = format!(
            "these samples have stamps of two clocks: {} {} longer than 12 days, first from {} s to {} s",
            counted(others.len(), "step"),
            by_count(others.len(), "is", "are"),
            seconds(*before),
            seconds(*row)
        );
        let rows: Vec<usize> = others.iter().map(|(_, row)| *row).collect();
        found.push(evidence.found(Severity::Warning, message, &rows));
    }
    found.extend(set_within(evidence));
    found.extend(set_back(evidence));
    let last = last_stamps(table);
    found.extend(of_two_kinds(&last).filter(|_| others.is_empty()));
    found.extend(contradicted(evidence, &last));
    found
}

/// Latest time stamp of each clock, s.
fn last_stamps(table: &Table) -> Vec<f64> {
    let mut last: BTreeMap<(Option<&str>, Option<&str>), f64> = BTreeMap::new();
    for (row, time) in table.t_s().iter().enumerate() {
        let Some(time) = *time else { continue };
        let clock = (
            table.unit_id()[row].as_deref(),
            table.source_table()[row].as_deref(),
        );
        let known = last.entry(clock).or_insert(time);
        *known = known.max(time);
    }
    last.into_values().collect()
}

/// Finds Unix clocks in a recording that also has clocks counting from the start of a device.
fn of_two_kinds(last: &[f64]) -> Option<Found> {
    let least = last.iter().copied().reduce(f64::min)?;
    let most = last.iter().copied().reduce(f64::max)?;
    let message = format!(
        "two clocks in one column: some tables or units have stamps since 1970 (such as {most} s), others since a start (such as {least} s)"
    );
    (least < RUNNING_S.min(UNIX_FROM_S) && most > RUNNING_S)
        .then(|| Found::overall(Severity::Warning, message))
}

/// Finds time stamps that jump ahead by less than `TWO_CLOCKS_S`, within one contact or between rows without contact points.
fn set_within(evidence: &Evidence<'_>) -> Vec<Found> {
    let Some(stream) = Stream::of(evidence) else {
        return Vec::new();
    };
    let table = evidence.table;
    let jumps = stream.steps.iter().copied().filter(|step| {
        step.seconds > JUMP_S
            && step.seconds > JUMP_STEPS * stream.usual_s
            && step.seconds <= TWO_CLOCKS_S
    });
    let (within, mut without): (Vec<Step>, Vec<Step>) =
        jumps.partition(|step| table.point_id()[step.to].is_some());
    // Recording stops where the scene or the repeat changes.
    without.retain(|step| {
        table.scene()[step.to] == table.scene()[step.from]
            && table.repeat()[step.to] == table.repeat()[step.from]
    });
    let steps = stream.steps.len();
    let regular = stream.steps.iter();
    let regular = regular
        .filter(|step| step.seconds <= REGULAR_STEPS * stream.usual_s)
        .count();
    if without.len() > (steps / SELDOM).max(1) || regular < steps - steps / 10 {
        without.clear();
    }
    let found = [
        (within, "within a contact"),
        (without, "between samples without contact points"),
    ];
    found
        .into_iter()
        .filter_map(|(jumps, place)| jumped(evidence, &stream, &jumps, place))
        .collect()
}

fn jumped(evidence: &Evidence<'_>, stream: &Stream, jumps: &[Step], place: &str) -> Option<Found> {
    let longest = jumps.iter().map(|step| step.seconds).reduce(f64::max)?;
    let rows: Vec<usize> = jumps.iter().map(|step| step.to).collect();
    let steps = counted(rows.len(), "step");
    let [are, the_longest] = by_count(rows.len(), ["is", ""], ["are", "the longest "]);
    let message = format!(
        "{steps} {place} {are} over {JUMP_STEPS} times the usual step of {:.4} s, {the_longest}{longest:.3} s: the clock was set or the recording paused",
        stream.usual_s
    );
    Some(evidence.found(Severity::Warning, message, &rows))
}

/// Finds a stream of Unix times whose only backward steps are one hour long.
fn set_back(evidence: &Evidence<'_>) -> Option<Found> {
    if !matches!(evidence.header.clock, Clock::Unix) {
        return None;
    }
    let stream = Stream::of(evidence)?;
    let back = stream.steps.iter().filter(|step| step.seconds < 0.0);
    let back: Vec<&Step> = back.collect();
    let is_hour = |step: &&Step| (step.seconds + SUMMER_TIME_S).abs() < NEAR_S;
    let first = back.first().filter(|_| back.iter().all(is_hour))?;
    let rows: Vec<usize> = back.iter().map(|step| step.to).collect();
    let time = |row: usize| evidence.table.t_s()[row].unwrap_or_default();
    let message = format!(
        "{} {} about an hour back, first from {:.3} s to {:.3} s: local times at the end of summer time; write times in UTC or with their zone",
        counted(rows.len(), "step"),
        by_count(rows.len(), "is", "are"),
        time(first.from),
        time(first.to)
    );
    Some(evidence.found(Severity::Warning, message, &rows))
}

/// Finds a declared clock that contradicts the latest time stamps.
fn contradicted(evidence: &Evidence<'_>, last: &[f64]) -> Option<Found> {
    let least = last.iter().copied().reduce(f64::min)?;
    let most = last.iter().copied().reduce(f64::max)?;
    let message = match evidence.header.clock {
        Clock::Unix if least < UNIX_FROM_S => format!(
            "the clock is declared `unix`, but the last stamp, {least} s, is before 1990: check its unit"
        ),
        Clock::Unix if most > UNIX_TO_S => format!(
            "the clock is declared `unix`, but the last stamp, {most} s, is after 2100: check its unit"
        ),
        Clock::Monotonic if most > RUNNING_S => format!(
            "the clock is declared `monotonic`, but the last stamp, {most} s, exceeds the uptime of any machine"
        ),
        _ => return None,
    };
    Some(Found::overall(Severity::Warning, message))
}
