//! TAC036: labels joined by repeated times: whole seconds, or a stopped clock.

use std::collections::BTreeSet;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use crate::stamps::repeated;

pub(super) static CHECK: Check = Check {
    code: "TAC036",
    name: "repeated-stamps",
    looks_for: "labels that were joined by time although rows share their times: nobody can say how far away a match is",
    hint: "join by a clock with fractions of a second; where there is none, join by the number of the row (`row = true`) if both tables were written in step",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let joins = evidence.header.joins.iter();
    let by_time: Vec<&str> = joins
        .filter(|join| join.by == "time")
        .map(|join| join.name.as_str())
        .collect();
    let Some(shared) = repeated(evidence.table).filter(|_| !by_time.is_empty()) else {
        return Vec::new();
    };
    let times = evidence.table.t_s().iter().flatten();
    let mut different: Vec<f64> = times
        .map(|time| time.to_bits())
        .collect::<BTreeSet<u64>>()
        .into_iter()
        .map(f64::from_bits)
        .collect();
    different.sort_by(f64::total_cmp);
    let timed = evidence.table.t_s().iter().flatten().count();
    let steps = different.windows(2).map(|pair| pair[1] - pair[0]);
    let longest = steps.fold(0.0, f64::max);
    let off = match different.len() {
        1 => "so that any row may have any label".to_owned(),
        _ => format!("so that a match may be up to {longest:.3} s off"),
    };
    let joined = by_time
        .iter()
        .map(|name| format!("`{}`", taceva_core::shown(name)))
        .collect::<Vec<_>>()
        .join(", ");
    let message = format!(
        "{timed} rows have {} different times and were joined with {joined} by them: rows of one time get the labels of the same row, {off}",
        different.len()
    );
    vec![Found::about(
        Severity::Warning,
        message,
        evidence.names(&shared),
    )]
}
