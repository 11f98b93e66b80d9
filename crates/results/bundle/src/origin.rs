//! Compares subject and inputs of results with their states.

use taceva_core::shown;
use taceva_results::{EvaluationReport, OPTIMISTIC, Provenance};

/// Parts of `report` whose subject or inputs differ from the states, each with the reason.
///
/// States of a run contain only facts of the recording. Settings are compared only if a state contains them.
pub(crate) fn differences(
    report: &EvaluationReport,
    state: &EvaluationReport,
) -> Vec<(&'static str, String)> {
    let mut found = Vec::new();
    if report.subject != state.subject {
        let [own, other] = [report, state].map(|report| {
            let subject = &report.subject;
            format!(
                "{}, serial {}, gel {}, samples {}",
                subject.sensor, subject.serial, subject.gel, subject.source
            )
        });
        found.push(("subject", format!("{own}; the state has {other}")));
    }
    let (own, other) = (&report.provenance, &state.provenance);
    let other_than = |part: &str| format!("results.json has another {part} than the state");
    for (part, is_same) in [
        ("dataset", own.dataset == other.dataset),
        ("tables", own.tables == other.tables),
        ("recordings", recordings(own) == recordings(other)),
        (
            "traceability",
            own.traceability.len() == other.traceability.len()
                && (own.traceability.iter()).all(|one| other.traceability.contains(one)),
        ),
        ("devices", own.devices == other.devices),
        ("model", other.model.is_none() || own.model == other.model),
        ("split", other.split.is_none() || own.split == other.split),
        ("part", other.part.is_none() || own.part == other.part),
        ("seed", other.seed.is_none() || own.seed == other.seed),
    ] {
        if !is_same {
            found.push((part, other_than(part)));
        }
    }
    let mut phases = own.phases.iter().chain(&other.phases);
    let is_other = |of: &(&String, &String)| own.phases.get(of.0) != other.phases.get(of.0);
    if let Some((metric, _)) = phases.find(is_other) {
        let [in_results, in_state] = [own, other].map(|from| {
            let phase = from.phases.get(metric);
            phase.map_or_else(|| "none".to_owned(), |phase| format!("`{}`", shown(phase)))
        });
        let reason = format!(
            "results.json has {} of the phase {in_results}; the state has {in_state}",
            shown(metric)
        );
        found.push(("phases", reason));
    }
    let mut notes = other.notes.iter();
    let is_hidden = |note: &&String| note.contains(OPTIMISTIC) && !own.notes.contains(note);
    if let Some(note) = notes.find(is_hidden) {
        found.push(("notes", format!("results.json lacks the note: {note}")));
    }
    found
}

/// Digests of the recordings, ascending: states may be merged in any order.
fn recordings(provenance: &Provenance) -> Vec<&str> {
    let recordings = provenance.recordings.iter();
    let mut digests: Vec<&str> = recordings.map(|own| own.digest.as_str()).collect();
    digests.sort_unstable();
    digests
}
