//! TAC026: frames with lossy coding, whose pixels depend on the decoder.

use taceva_core::{by_count, counted};

use crate::evidence::Evidence;
use crate::finding::{Check, Found, Severity};

pub(super) static CHECK: Check = Check {
    code: "TAC026",
    name: "lossy-frames",
    looks_for: "frames in JPEG or from lossy clips, whose pixels differ by a few levels between decoders",
    hint: "fit and evaluate a model with the same decoder; programs with other decoders give other scores on the same files (docs/your-recording.md)",
    reads: None,
    find,
};

fn find(evidence: &Evidence<'_>) -> Vec<Found> {
    let Some(frames) = &evidence.header.frames else {
        return Vec::new();
    };
    if let Some(codec) = frames
        .codec
        .as_ref()
        .filter(|codec| codec.lossy == Some(true))
    {
        let by = codec
            .decoder
            .as_deref()
            .unwrap_or("the program that opens them");
        let message = format!(
            "the frames were imported from {} ({}), which is lossy, and decoded by {by}",
            codec.name, codec.pixel_format
        );
        return vec![Found::overall(Severity::Note, message)];
    }
    let is_jpeg = |path: &str| {
        let ending = path.rsplit('.').next().unwrap_or_default();
        ["jpg", "jpeg"]
            .iter()
            .any(|known| ending.eq_ignore_ascii_case(known))
    };
    let paths = evidence.table.frames().iter().flatten();
    let jpegs = paths.filter(|frame| is_jpeg(&frame.path)).count();
    if jpegs == 0 {
        return Vec::new();
    }
    let message = format!(
        "{} {} JPEG: other decoders give pixels that differ by a few of 255 levels",
        counted(jpegs, "frame"),
        by_count(jpegs, "is", "are")
    );
    vec![Found::overall(Severity::Note, message)]
}
