//! Records of a ROS 1 bag: a head of named fields, then data.

use std::ops::Range;
use std::sync::Arc;

use crate::bytes::Bytes;
use crate::message::{Channel, Schema};

/// Number of nanoseconds per second.
pub(super) const NANO: u64 = 1_000_000_000;

/// Type codes of the records of a ROS 1 bag.
pub(super) mod op {
    pub(in crate::rosbag1) const MESSAGE: u8 = 0x02;
    pub(in crate::rosbag1) const BAG: u8 = 0x03;
    pub(in crate::rosbag1) const INDEX: u8 = 0x04;
    pub(in crate::rosbag1) const CHUNK: u8 = 0x05;
    pub(in crate::rosbag1) const CHUNK_INFO: u8 = 0x06;
    pub(in crate::rosbag1) const CONNECTION: u8 = 0x07;
}

/// Head of a record.
#[derive(Debug)]
pub(super) struct Head {
    fields: Vec<u8>,
    /// Offset of the data of the record in the file.
    pub(super) data_at: u64,
    /// Offset of the end of the record in the file.
    pub(super) end: u64,
}

impl Head {
    /// Parses the head. Each field has its length, its name, `=` and its value. `None` if the last field does not end at the end of `fields`.
    pub(super) fn new(fields: Vec<u8>, data_at: u64, end: u64) -> Option<Head> {
        let mut bytes = Bytes::new(&fields);
        while !bytes.rest().is_empty() {
            next(&mut bytes)?;
        }
        Some(Head {
            fields,
            data_at,
            end,
        })
    }

    /// Value of the field `name`.
    pub(super) fn bytes(&self, name: &str) -> Option<&[u8]> {
        let mut bytes = Bytes::new(&self.fields);
        while !bytes.rest().is_empty() {
            let (known, value) = next(&mut bytes)?;
            if known == name.as_bytes() {
                return Some(value);
            }
        }
        None
    }

    /// Little-endian bytes of a number in the field `name`.
    pub(super) fn number<const N: usize>(&self, name: &str) -> Option<[u8; N]> {
        self.bytes(name)?.try_into().ok()
    }

    /// Text in the field `name`.
    pub(super) fn text(&self, name: &str) -> Option<String> {
        String::from_utf8(self.bytes(name)?.to_vec()).ok()
    }

    /// Type code of the record.
    pub(super) fn op(&self) -> Option<u8> {
        self.number::<1>("op").map(|[code]| code)
    }

    /// Time of the message in this record, ns since 1970.
    pub(super) fn time_ns(&self) -> Option<u64> {
        let [a, b, c, d, rest @ ..] = self.number::<8>("time")?;
        let seconds = u64::from(u32::from_le_bytes([a, b, c, d]));
        Some(seconds * NANO + u64::from(u32::from_le_bytes(rest)))
    }
}

/// Takes the name and the value of the next field from `bytes`.
fn next<'b>(bytes: &mut Bytes<'b>) -> Option<(&'b [u8], &'b [u8])> {
    let length = usize::try_from(bytes.u32()?).ok()?;
    let field = bytes.take(length)?;
    let end = field.iter().position(|byte| *byte == b'=')?;
    Some((&field[..end], &field[end + 1..]))
}

/// Head of the record at the offset `at` of the unpacked chunk `held`, and the range of its data.
pub(super) fn within(held: &[u8], at: usize) -> Option<(Head, Range<usize>)> {
    let mut bytes = Bytes::new(held.get(at..)?);
    let length = usize::try_from(bytes.u32()?).ok()?;
    let fields = bytes.take(length)?.to_vec();
    let data = usize::try_from(bytes.u32()?).ok()?;
    let begin = at + bytes.at();
    bytes.take(data)?;
    Some((Head::new(fields, 0, 0)?, begin..begin + data))
}

/// Parses a connection record to the number of the connection and its channel.
pub(super) fn connection(head: &Head, data: &[u8]) -> Option<(u32, Channel)> {
    let number = head.number::<4>("conn").map(u32::from_le_bytes)?;
    let said = Head::new(data.to_vec(), 0, 0)?;
    let schema = Schema {
        name: said.text("type")?,
        encoding: "ros1msg".to_owned(),
        text: said.bytes("message_definition")?.to_vec(),
    };
    let channel = Channel {
        topic: head.text("topic")?,
        encoding: "ros1".to_owned(),
        schema: Some(Arc::new(schema)),
        count: 0,
    };
    Some((number, channel))
}
