//! TAC003: red and blue swapped, in some or all frames.

use taceva_core::Field;

use crate::evidence::{Evidence, FrameFacts};
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC003",
    name: "channel-order",
    looks_for: "frames whose colours fit better with red and blue swapped",
    hint: "OpenCV stores blue first; set `channel_order` in the map to the order in the files",
    reads: Some(Field::Frame),
    find,
};

/// Difference between the mean red and the mean blue of a frame that is too large for a change of light, as a fraction of full scale.
const CLEAR: f64 = 0.02;

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let rows = evidence.frames.iter().enumerate();
    let frames: Vec<(usize, &FrameFacts)> = rows
        .filter_map(|(row, facts)| Some((row, facts.as_ref()?)))
        .collect();
    let Some(anchor) = evidence
        .reference
        .map(red_less_blue)
        .or_else(|| median(&frames))
    else {
        return Vec::new();
    };
    let swapped: Vec<usize> = frames
        .iter()
        .filter(|(_, facts)| {
            let seen = red_less_blue(facts);
            seen * anchor < 0.0
                && (seen + anchor).abs() < (seen - anchor).abs() / 2.0
                && seen.abs() > CLEAR
        })
        .map(|(row, _)| *row)
        .collect();
    if swapped.is_empty() || anchor.abs() <= CLEAR {
        return Vec::new();
    }
    let against = if evidence.reference.is_some() {
        "the reference frame"
    } else {
        "most frames"
    };
    let message = format!(
        "{} of {} frames have red and blue swapped compared with {against}",
        swapped.len(),
        frames.len()
    );
    vec![evidence.found(Severity::Warning, message, &swapped)]
}

fn red_less_blue(facts: &FrameFacts) -> f64 {
    facts.mean[0] - facts.mean[2]
}

fn median(frames: &[(usize, &FrameFacts)]) -> Option<f64> {
    let mut differences: Vec<f64> = frames
        .iter()
        .map(|(_, facts)| red_less_blue(facts))
        .collect();
    differences.sort_by(f64::total_cmp);
    differences.get(differences.len() / 2).copied()
}
