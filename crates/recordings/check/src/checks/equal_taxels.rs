//! TAC039: taxels with the same value in every row.

use std::collections::BTreeMap;

use taceva_core::{Field, counted, shown};

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC039",
    name: "equal-taxels",
    looks_for: "taxels that change but equal another taxel in every row: a column that is named twice, or two places that are wired together",
    hint: "name each column once under [signals]; if both are one place of the sensor, remove one",
    reads: Some(Field::Signals),
    find,
};

/// Minimum number of rows. In fewer rows, two taxels may be equal by chance.
const LEAST: u64 = 5;
/// Maximum number of taxels named in a message.
const NAMED: usize = 5;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let Some(facts) = evidence.signals.filter(|facts| facts.samples >= LEAST) else {
        return Vec::new();
    };
    let mut alike: BTreeMap<u64, Vec<&str>> = BTreeMap::new();
    for (taxel, name) in facts.taxels.iter().zip(&facts.names) {
        if !taxel.is_stuck() {
            alike.entry(taxel.series).or_default().push(name);
        }
    }
    let mut groups: Vec<Vec<&str>> = alike.into_values().filter(|all| all.len() > 1).collect();
    groups.sort_unstable();
    let Some(first) = groups.first() else {
        return Vec::new();
    };
    let count: usize = groups.iter().map(Vec::len).sum();
    let named: Vec<String> = first
        .iter()
        .take(NAMED)
        .map(|name| format!("`{}`", shown(name)))
        .collect();
    let message = format!(
        "{count} taxels are equal to another one in all {}, such as {}",
        counted(facts.samples, "row"),
        named.join(" and ")
    );
    vec![Found::overall(Severity::Warning, message)]
}
