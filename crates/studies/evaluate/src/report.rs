//! JSON form of skipped metrics and checks.

use serde::ser::SerializeSeq;
use serde::{Serialize, Serializer};
use taceva_core::Skipped;

/// Writes skipped items as `[{"what": …, "reason": …}]`.
pub fn skipped<S: Serializer>(list: &[Skipped], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Line<'a> {
        what: &'a str,
        reason: String,
    }
    let mut sequence = serializer.serialize_seq(Some(list.len()))?;
    for skipped in list {
        sequence.serialize_element(&Line {
            what: &skipped.what,
            reason: skipped.reason.to_string(),
        })?;
    }
    sequence.end()
}
