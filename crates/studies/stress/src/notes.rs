//! Limits of what the numbers of a stress test contain.

use crate::fault::{Fault, Scope};

/// Limits of the numbers of `faults`, drawn by `seed`.
pub(crate) fn notes(faults: &[&'static Fault], seed: u64) -> Vec<String> {
    let mut notes = Vec::new();
    let drawn = faults.iter().filter(|fault| fault.scope == Scope::Drawn);
    let drawn: Vec<&str> = drawn.map(|fault| fault.id).collect();
    if !drawn.is_empty() {
        notes.push(format!(
            "{}: one draw of places, by seed {seed}; the interval does not contain their chance, so repeat with another --seed.",
            drawn.join(", ")
        ));
    }
    notes
}
