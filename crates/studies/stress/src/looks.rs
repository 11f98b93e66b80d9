//! Checks of a recording, applied to its pictures with a fault.

use std::collections::BTreeSet;

use taceva_check::{FrameFacts, codes_of_pictures};
use taceva_core::Frame;
use taceva_core::random::fnv_1a;
use taceva_dataset::Dataset;

/// Statistics of a picture that the checks of a recording use.
#[derive(Clone, Debug)]
pub(crate) struct Look {
    facts: FrameFacts,
    /// Hash of the bytes of the picture, which finds repeated pictures.
    hash: u64,
}

impl Look {
    /// Statistics of `frame`, also relative to the untouched picture `reference`, if any.
    pub(crate) fn of(frame: &Frame, reference: Option<&Frame>) -> Look {
        Look {
            facts: FrameFacts::without_tiles(frame, reference),
            hash: fnv_1a(frame.bytes()),
        }
    }
}

/// Codes of the checks of a recording that find something in `looks`, the statistics of the pictures of `rows`.
pub(crate) fn codes<'l>(
    dataset: &Dataset,
    rows: &[usize],
    looks: impl Iterator<Item = &'l Look>,
    reference: Option<&Frame>,
) -> Vec<&'static str> {
    let mut frames = vec![None; dataset.table().rows()];
    let mut hashes = BTreeSet::new();
    let mut has_repeats = false;
    for (row, look) in rows.iter().zip(looks) {
        frames[*row] = Some(look.facts.clone());
        has_repeats |= !hashes.insert(look.hash);
    }
    let reference = reference.map(|frame| FrameFacts::without_tiles(frame, None));
    codes_of_pictures(dataset, &frames, reference.as_ref(), has_repeats)
}
