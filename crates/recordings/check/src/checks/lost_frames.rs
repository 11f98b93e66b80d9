//! TAC015: frames delivered by the stream but missing from the recording.

use taceva_core::by_count;

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC015",
    name: "lost-frames",
    looks_for: "frames that a capture lost, by its own count",
    hint: "stop other programs during the capture, record to a faster disk, or let the camera send fewer or smaller frames",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let Some(stream) = evidence.header.stream else {
        return Vec::new();
    };
    let mut found = Vec::new();
    if stream.lost() > 0 {
        let came = evidence.header.table.rows.saturating_add(stream.lost());
        found.push(Found::overall(
            Severity::Warning,
            format!(
                "{} of {came} frames of the stream are not in the recording: {} {} dropped, {} {} damaged",
                stream.lost(),
                stream.dropped,
                by_count(stream.dropped, "was", "were"),
                stream.damaged,
                by_count(stream.damaged, "was", "were")
            ),
        ));
    }
    if !stream.numbered {
        found.push(Found::overall(
            Severity::Note,
            "the camera does not number its frames, so frames lost before they arrived are not counted"
                .to_owned(),
        ));
    }
    found
}
