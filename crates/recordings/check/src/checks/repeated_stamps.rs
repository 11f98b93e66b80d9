//! TAC036: labels joined by time stamps that repeat, because a clock counts whole seconds or has stopped.

use std::collections::BTreeSet;

use taceva_core::counted;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};
use crate::stamps::repeated;

pub(super) static CHECK: Check = Check {
    code: "TAC036",
    name: "repeated-stamps",
    looks_for: "labels joined by a time that several rows share, so matches may be wrong",
    hint: "join by a clock with fractions of a second; if there is none, join by row number (`on = \"row\"`) if both tables were written in \
        step",
    reads: None,
    find,
};

pub(super) fn find(evidence: &Evidence<'_>) -> Vec<Found> {
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
        1 => "so any row may have any label".to_owned(),
        _ => format!("so a match may be wrong by as much as {longest:.3} s"),
    };
    let joined = by_time
        .iter()
        .map(|name| format!("`{}`", taceva_core::shown(name)))
        .collect::<Vec<_>>()
        .join(", ");
    let message = format!(
        "{timed} rows were joined with {joined} by only {}: rows of equal time get the labels of the same row, {off}",
        counted(different.len(), "different time")
    );
    vec![evidence.found(Severity::Warning, message, &shared)]
}
