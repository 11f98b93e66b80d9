//! TAC016: a taxel that never changes.

use taceva_core::Field;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC016",
    name: "stuck-taxel",
    looks_for: "taxels with the same value in every sample",
    hint: "check the wire and the address of the taxel; a model gives a constant no weight, so contact there is not seen",
    reads: Some(Field::Signals),
    find,
};

/// Minimum number of samples for a finding about a constant taxel.
const LEAST: u64 = 10;
/// Maximum number of taxels named in a message; the others are counted.
const NAMED: usize = 5;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let Some(facts) = evidence.signals.filter(|facts| facts.samples >= LEAST) else {
        return Vec::new();
    };
    let taxels = facts.names.iter().zip(&facts.taxels);
    let stuck: Vec<String> = taxels
        .filter(|(_, taxel)| taxel.is_stuck())
        .map(|(name, taxel)| format!("{name} is {} {}", taxel.least.value, facts.info.unit))
        .collect();
    if stuck.is_empty() {
        return Vec::new();
    }
    let named = stuck[..stuck.len().min(NAMED)].join(", ");
    let message = format!(
        "{} of {} signals are the same in every sample: {named}",
        stuck.len(),
        facts.taxels.len()
    );
    vec![Found::overall(Severity::Warning, message)]
}
