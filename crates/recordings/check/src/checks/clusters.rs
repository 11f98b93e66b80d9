//! TAC010: too few contact points for a confidence interval.

use std::collections::BTreeSet;

use taceva_core::counted;
use taceva_metrics::LEAST_CLUSTERS;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC010",
    name: "few-points",
    looks_for: "test parts with fewer than five contact points, groups or independent samples",
    hint: "map the column that groups repeats as point_id, record more points, or predict every sample once: --split cv:5",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let points = evidence.table.point_id();
    let all: Vec<usize> = (0..points.len()).collect();
    let rows = evidence.scored.map_or(&all, |divided| &divided.split.test);
    if let Some(groups) = evidence.scored.and_then(|divided| divided.groups.as_ref()) {
        let distinct: BTreeSet<_> = rows.iter().map(|&row| &groups[row]).collect();
        return few(distinct.len(), "group");
    }
    if evidence
        .scored
        .is_some_and(|divided| divided.are_independent)
    {
        return few(rows.len(), "independent sample");
    }
    let unnamed = rows.iter().filter(|&&row| points[row].is_none()).count();
    if unnamed > 0 {
        let message = format!(
            "{unnamed} of {} test samples lack a point_id, so scores have no intervals",
            rows.len()
        );
        return vec![Found::overall(Severity::Warning, message)];
    }
    let distinct: BTreeSet<_> = rows.iter().map(|&row| &points[row]).collect();
    few(distinct.len(), "contact point")
}

/// Finding for `count` clusters of the kind `kind`, if these are fewer than a confidence interval needs.
fn few(count: usize, kind: &str) -> Vec<Found> {
    if count == 0 || count >= LEAST_CLUSTERS {
        return Vec::new();
    }
    let message = format!(
        "the test part has {}; intervals need {LEAST_CLUSTERS}",
        counted(count, kind)
    );
    vec![Found::overall(Severity::Warning, message)]
}
