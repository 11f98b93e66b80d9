//! TAC010: too few contact points for an interval.

use std::collections::BTreeSet;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC010",
    name: "few-points",
    looks_for: "test parts without contact points, or with fewer than five",
    hint: "name what repeats share as point_id in the map, record more points, or test on more of them: --split 'by-point 50/10/40'",
    reads: None,
    find,
};

/// Clusters below which the jackknife gives no interval.
const LEAST: usize = 5;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let points = evidence.table.point_id();
    let all: Vec<usize> = (0..points.len()).collect();
    let rows = evidence.split.map_or(&all, |split| &split.test);
    let unnamed = rows.iter().filter(|&&row| points[row].is_none()).count();
    if unnamed > 0 {
        let message = format!(
            "{unnamed} of {} test samples have no point_id: no score gets an interval",
            rows.len()
        );
        return vec![Found::overall(Severity::Warning, message)];
    }
    let distinct: BTreeSet<_> = rows.iter().map(|&row| &points[row]).collect();
    if distinct.len() >= LEAST || rows.is_empty() {
        return Vec::new();
    }
    let message = format!(
        "the test part has {} contact points, {LEAST} are needed for an interval",
        distinct.len()
    );
    vec![Found::overall(Severity::Warning, message)]
}
