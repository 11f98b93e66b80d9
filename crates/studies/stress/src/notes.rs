//! Limits of what the numbers of a stress test contain.

use taceva_core::counted;
use taceva_metrics::LEAST_CLUSTERS;

use crate::fault::{Fault, Scope};
use crate::score::Scored;
use crate::setup::StressRequest;

/// Limits of the numbers of `faults`, as requested. `clean` has the scores of `samples` predicted samples without a fault.
pub(crate) fn notes(
    faults: &[&'static Fault],
    request: &StressRequest,
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
        let (names, seed) = (drawn.join(", "), request.seed);
        notes.push(match request.draws {
            1 => format!(
                "{names}: one draw of places, by seed {seed}; the interval does not contain their chance, so repeat with --draws 5."
            ),
            draws => format!(
                "{names}: means over {draws} draws of places, by seed {seed}; the interval does not contain their chance, the spread shows it."
            ),
        });
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
