//! Checks of a recording whose pictures or signals were changed in memory.

use taceva_dataset::Dataset;

use crate::checks::{OF_PICTURES, OF_SIGNALS, duplicate_frames};
use crate::evidence::{Evidence, FrameFacts};
use crate::finding::Check;
use crate::signal_facts::SignalFacts;

/// Codes of the checks that find something in changed pictures of `dataset`, ascending. `frames` has the statistics of the picture of each row, with
/// or without tiles. `has_repeats` is true if two pictures are equal.
///
/// Runs the checks that need pictures and labels alone: duplicates, order of colours, saturation, a pressed reference, blank pictures, and a dead zone.
pub fn codes_of_pictures(
    dataset: &Dataset,
    frames: &[Option<FrameFacts>],
    reference: Option<&FrameFacts>,
    has_repeats: bool,
) -> Vec<&'static str> {
    let evidence = Evidence {
        frames,
        reference,
        ..of_labels(dataset)
    };
    let repeats = has_repeats.then_some(duplicate_frames::CHECK.code);
    let found = codes(&OF_PICTURES, &evidence);
    repeats.into_iter().chain(found).collect()
}

/// Codes of the checks that find something in changed signals of `dataset`, ascending. `facts` has the statistics of the changed signals.
///
/// Runs the checks that need signals alone: stuck, clipped and equal taxels.
pub fn codes_of_signals(dataset: &Dataset, facts: &SignalFacts) -> Vec<&'static str> {
    let evidence = Evidence {
        signals: Some(facts),
        ..of_labels(dataset)
    };
    codes(&OF_SIGNALS, &evidence).collect()
}

/// Evidence that consists of the header and the table of `dataset`, without pictures and signals.
fn of_labels(dataset: &Dataset) -> Evidence<'_> {
    Evidence {
        header: dataset.header(),
        table: dataset.table(),
        clusters: &[],
        divided: None,
        is_split_named: false,
        scored: None,
        of_tasks: &[],
        frames: &[],
        reference: None,
        signals: None,
        maps: &[],
        damaged: &[],
        sessions: None,
    }
}

/// Codes of the `checks` that find something.
fn codes(checks: &[&Check], evidence: &Evidence<'_>) -> impl Iterator<Item = &'static str> {
    let found = checks
        .iter()
        .filter(move |check| !(check.find)(evidence).is_empty());
    found.map(|check| check.code)
}
