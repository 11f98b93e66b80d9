//! Binary message format between the host and its child: little-endian, with every length checked before use.
//!
//! A message is one packet of at most [`MESSAGE_MAX`] bytes. Reading never panics and allocates no more than the packet length. A message
//! with trailing bytes is rejected.

mod any;
mod basic;
mod bench;
mod describe;
mod device;
#[cfg(test)]
mod golden;
mod macros;
mod message;
mod model;
mod value;

pub use any::read_any_message;
pub(crate) use bench::{BenchAnswer, BenchCall};
pub(crate) use device::{Answer, Call, OpenedDevice, Urgent};
pub(crate) use macros::{fields, messages, variants};
pub(crate) use message::{Failure, FirstWord, Greeting, Hello, Order, OrderAnswer};
pub(crate) use model::{ModelAnswer, ModelCall, ModelEvent, ModelOrder, ModelWord, SetShape};

use std::fmt;

/// Maximum message length, bytes. Images and arrays use shared memory.
pub(crate) const MESSAGE_MAX: usize = 64 * 1024;

/// A value with a binary encoding.
pub(crate) trait Wire: Sized {
    /// Appends the encoding to `into`.
    fn write(&self, into: &mut Vec<u8>);

    /// Reads a value from the front of `from`.
    fn read(from: &mut Reader<'_>) -> Result<Self, Malformed>;
}

/// Encodes a message into `into`. Fails if the message exceeds a packet.
pub(crate) fn encode(message: &impl Wire, into: &mut Vec<u8>) -> Result<(), TooLong> {
    into.clear();
    message.write(into);
    if into.len() > MESSAGE_MAX {
        return Err(TooLong { bytes: into.len() });
    }
    Ok(())
}

/// Decodes a message from all of `bytes`.
pub(crate) fn decode<T: Wire>(bytes: &[u8]) -> Result<T, Malformed> {
    let mut reader = Reader { bytes, at: 0 };
    let message = T::read(&mut reader)?;
    if reader.at < bytes.len() {
        return Err(reader.malformed("the end of the message"));
    }
    Ok(message)
}

/// A message that exceeds a packet.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct TooLong {
    bytes: usize,
}

impl fmt::Display for TooLong {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "{} bytes to be sent, expected at most {MESSAGE_MAX}",
            self.bytes
        )
    }
}

impl std::error::Error for TooLong {}

/// Invalid encoding of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Malformed {
    at: usize,
    expected: &'static str,
}

impl fmt::Display for Malformed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "byte {} of a message, expected {}",
            self.at, self.expected
        )
    }
}

impl std::error::Error for Malformed {}

/// Cursor over the unread bytes of a message.
pub(crate) struct Reader<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Reader<'a> {
    /// Error at the current position.
    pub(crate) fn malformed(&self, expected: &'static str) -> Malformed {
        Malformed {
            at: self.at,
            expected,
        }
    }

    fn take(&mut self, count: usize, expected: &'static str) -> Result<&'a [u8], Malformed> {
        let end = self.at.checked_add(count);
        match end.and_then(|end| self.bytes.get(self.at..end)) {
            Some(taken) => {
                self.at += count;
                Ok(taken)
            }
            None => Err(self.malformed(expected)),
        }
    }

    fn array<const N: usize>(&mut self, expected: &'static str) -> Result<[u8; N], Malformed> {
        let taken = self.take(N, expected)?;
        taken.try_into().map_err(|_| self.malformed(expected))
    }

    /// Reads an item count. Fails if the count exceeds the remaining bytes, because an item has at least one byte.
    fn count(&mut self) -> Result<usize, Malformed> {
        let left = self.bytes.len() - self.at;
        let count = u32::read(self)?;
        usize::try_from(count)
            .ok()
            .filter(|count| *count <= left)
            .ok_or_else(|| self.malformed("a count of items that the message holds"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_count_that_lies_is_refused_before_anything_is_allocated() {
        let mut bytes = Vec::new();
        u32::MAX.write(&mut bytes);
        let error = decode::<Vec<u64>>(&bytes).expect_err("four billion numbers in no byte");
        assert_eq!(
            error.to_string(),
            "byte 4 of a message, expected a count of items that the message holds"
        );
        assert!(decode::<String>(&bytes).is_err());
    }

    #[test]
    fn a_message_is_read_to_its_end() {
        let error = decode::<u8>(&[1, 2]).expect_err("a byte too many");
        assert_eq!(
            error.to_string(),
            "byte 1 of a message, expected the end of the message"
        );
        assert!(decode::<u64>(&[0; 7]).is_err());
        assert!(decode::<bool>(&[2]).is_err());
        assert!(decode::<String>(&[1, 0, 0, 0, 0xFF]).is_err());
    }

    #[test]
    fn what_no_packet_holds_is_refused_by_its_writer() {
        let text = "x".repeat(MESSAGE_MAX);
        let error = encode(&text, &mut Vec::new()).expect_err("four bytes too many");
        assert_eq!(
            error.to_string(),
            "65540 bytes to be sent, expected at most 65536"
        );
    }
}
