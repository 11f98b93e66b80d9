//! Checks of a recording whose pictures were changed in memory.

use taceva_dataset::Dataset;

use crate::checks::{OF_PICTURES, duplicate_frames};
use crate::evidence::{Evidence, FrameFacts};

/// Codes of the checks that find something in changed pictures of `dataset`, ascending. `frames` has the statistics of each row, and may lack tiles.
/// `has_repeats` is true if a picture equals an earlier one.
///
/// Runs the checks that need pictures and labels alone: duplicates, order of colours, saturation, a pressed reference, blank pictures, and a dead zone.
pub fn codes_of_pictures(
    dataset: &Dataset,
    frames: &[Option<FrameFacts>],
    reference: Option<&FrameFacts>,
    has_repeats: bool,
) -> Vec<&'static str> {
    let evidence = Evidence {
        header: dataset.header(),
        table: dataset.table(),
        clusters: &[],
        divided: None,
        is_split_named: false,
        scored: None,
        of_tasks: &[],
        frames,
        reference,
        signals: None,
        maps: &[],
        damaged: &[],
        sessions: None,
    };
    let repeats = has_repeats.then_some(duplicate_frames::CHECK.code);
    let found = OF_PICTURES
        .iter()
        .filter(|check| !(check.find)(&evidence).is_empty());
    let found = found.map(|check| check.code);
    repeats.into_iter().chain(found).collect()
}
