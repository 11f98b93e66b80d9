//! Digest of everything that decides a number computed from a dataset.

use super::{Extension, FramesInfo};
use crate::digest::{Digest, PartsDigest};
use crate::signals::SignalsInfo;

/// The digest of a dataset: of its table, which holds the digest of each frame in order, and of what else decides what a
/// frame looks like when decoded.
pub(crate) fn dataset_digest(table: Digest, frames: Option<&FramesInfo>) -> Digest {
    let mut digest = PartsDigest::default();
    digest.part(b"taceva.dataset/1");
    digest.fixed(table.as_bytes());
    if let Some(frames) = frames {
        digest.part(frames.channel_order.name().as_bytes());
        if let Some(reference) = &frames.reference {
            digest.fixed(reference.sha256.as_bytes());
        }
    }
    digest.finish()
}

/// The digest of a dataset with its signals, where it has any, and with what it was before rows were added, which decides its parts; `others` is
/// the digest without them, which its header states.
pub(crate) fn digest_with(
    others: Digest,
    signals: Option<&SignalsInfo>,
    extended: &[Extension],
) -> Digest {
    let with_signals = match signals {
        None => others,
        Some(signals) => {
            let mut digest = PartsDigest::default();
            digest.part(b"taceva.dataset/1 with signals");
            digest.fixed(others.as_bytes());
            digest.fixed(signals.digest.as_bytes());
            digest.finish()
        }
    };
    if extended.is_empty() {
        return with_signals;
    }
    let mut digest = PartsDigest::default();
    digest.part(b"taceva.dataset/1 extended");
    digest.fixed(with_signals.as_bytes());
    for before in extended {
        digest.part(&before.rows.to_le_bytes());
        digest.fixed(before.digest.as_bytes());
    }
    digest.finish()
}
