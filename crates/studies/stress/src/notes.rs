//! Notes on the limitations of the numbers of a stress test.

use taceva_core::counted;
use taceva_metrics::LEAST_CLUSTERS;

use crate::fault::{Fault, Scope};
use crate::score::Scored;

/// Limitations of the numbers of `faults`, drawn by `seed`. `clean` has the scores of `samples` predicted samples without a fault.
pub(crate) fn notes(
    faults: &[&'static Fault],
    seed: u64,
    clean: &Scored,
    samples: usize,
) -> Vec<String> {
    let mut notes = Vec::new();
    match clean.clusters() {
        Some(count) if count < LEAST_CLUSTERS => notes.push(format!(
            "No intervals: {}, {LEAST_CLUSTERS} are needed; a cluster is a contact point or a group.",
            counted(count, "cluster")
        )),
        Some(_) => {}
        None => notes.push("No intervals of ratios: the samples name no contact points.".to_owned()),
    }
    let drawn = faults.iter().filter(|fault| fault.scope == Scope::Drawn);
    let drawn: Vec<&str> = drawn.map(|fault| fault.id).collect();
    if !drawn.is_empty() {
        notes.push(format!(
            "{}: the places were drawn once, with seed {seed}; the interval does not include their variation, so repeat with another --seed.",
            drawn.join(", ")
        ));
    }
    let counts = clean.names().map(|name| (name, clean.count(name)));
    let partial = counts.filter(|(_, count)| *count < samples as u64);
    let partial: Vec<String> = partial
        .map(|(name, count)| format!("{name} {count} of {samples}"))
        .collect();
    if !partial.is_empty() {
        notes.push(format!(
            "Not every sample has a label; scored samples: {}.",
            partial.join(", ")
        ));
    }
    notes
}
