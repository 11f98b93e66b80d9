//! Digest of everything that affects a number computed from a dataset.

use super::{Extension, FramesInfo, ViewInfo};
use crate::digest::{Digest, PartsDigest};
use crate::signals::SignalsInfo;

/// Digest of a dataset: covers the table with the digests of frames, the settings of frame decoding, and the signals. Also covers the states before rows were
/// added, because these states determine the parts of splits.
pub(crate) fn dataset_digest(
    table: Digest,
    frames: Option<&FramesInfo>,
    views: &[ViewInfo],
    signals: Option<&SignalsInfo>,
    extended: &[Extension],
) -> Digest {
    let mut digest = PartsDigest::default();
    digest.part(b"taceva.dataset/1");
    digest.fixed(table.as_bytes());
    if let Some(frames) = frames {
        digest.part(frames.channel_order.name().as_bytes());
        if let Some(reference) = &frames.reference {
            digest.fixed(reference.sha256.as_bytes());
        }
    }
    let mut whole = digest.finish();
    if !views.is_empty() {
        let mut digest = PartsDigest::default();
        digest.part(b"taceva.dataset/1 with views");
        digest.fixed(whole.as_bytes());
        for view in views {
            digest.part(view.name.as_bytes());
            digest.part(view.frames.channel_order.name().as_bytes());
            let reference = view.frames.reference.as_ref();
            digest.part(reference.map_or(&[], |reference| &reference.sha256.as_bytes()[..]));
        }
        whole = digest.finish();
    }
    if let Some(signals) = signals {
        let mut digest = PartsDigest::default();
        digest.part(b"taceva.dataset/1 with signals");
        digest.fixed(whole.as_bytes());
        digest.fixed(signals.digest.as_bytes());
        whole = digest.finish();
    }
    if extended.is_empty() {
        return whole;
    }
    let mut digest = PartsDigest::default();
    digest.part(b"taceva.dataset/1 extended");
    digest.fixed(whole.as_bytes());
    for before in extended {
        digest.part(&before.rows.to_le_bytes());
        digest.fixed(before.digest.as_bytes());
    }
    digest.finish()
}
