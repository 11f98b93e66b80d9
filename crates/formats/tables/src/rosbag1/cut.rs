//! Complete messages of a bag that was truncated or not closed.

use super::record::{self, op};
use super::{MAGIC, Records};
use crate::source::Source;

/// Remedy for a truncated bag, with the number of messages it recovers.
pub(super) fn remedy(source: &Source) -> String {
    format!(
        "{} complete messages are before the cut; recover them with `rosbag reindex FILE`",
        whole_messages(source)
    )
}

/// Number of messages in complete chunks, plus those in an uncompressed truncated chunk before its end.
fn whole_messages(source: &Source) -> u64 {
    let Ok(mut records) = Records::new(source) else {
        return 0;
    };
    let mut messages = 0;
    let mut at = MAGIC.len() as u64;
    while let Ok(Ok(head)) = records.head_within(at) {
        if head.op() == Some(op::CHUNK) {
            let Ok(chunk) = records.unpacked(at) else {
                return messages;
            };
            messages += messages_of(&chunk);
        }
        at = head.end;
    }
    messages + messages_of(&cut_chunk(&mut records, at).unwrap_or_default())
}

/// Bytes of the truncated chunk at `at`, if it is not compressed.
fn cut_chunk(records: &mut Records<'_>, at: u64) -> Option<Vec<u8>> {
    let length = records.source.length();
    let four = |records: &mut Records<'_>, at: u64| {
        let bytes = records.source.bytes(&mut records.file, at, 4, 4).ok()?;
        Some(u64::from(u32::from_le_bytes(bytes.try_into().ok()?)))
    };
    let fields_at = at + 4;
    let fields = four(records, at)?;
    let data_at = fields_at + fields + 4;
    four(records, fields_at + fields)?;
    let most = crate::limits::DESCRIPTION_BYTES;
    let fields = records
        .source
        .bytes(&mut records.file, fields_at, fields, most)
        .ok()?;
    let head = record::Head::new(fields, data_at, length)?;
    let is_plain = head.text("compression").as_deref() == Some("none");
    (head.op() == Some(op::CHUNK) && is_plain).then(|| records.data(&head).ok())?
}

/// Number of complete messages among the records of a chunk.
fn messages_of(chunk: &[u8]) -> u64 {
    let (mut at, mut messages) = (0, 0);
    while let Some((head, data)) = record::within(chunk, at) {
        messages += u64::from(head.op() == Some(op::MESSAGE));
        at = data.end;
    }
    messages
}
