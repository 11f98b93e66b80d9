//! Frames of the private protocol on port 502: a big-endian header, a register, parameters. No I/O.

use thiserror::Error;

/// Request to the controller: register and parameters.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Request {
    pub(super) register: u8,
    pub(super) parameters: Vec<u8>,
}

/// Size of the header, bytes. Transaction number, protocol number and length have two bytes each.
const HEADER: usize = 6;
/// Protocol number without keep-alive: the controller does not disconnect idle clients.
const PROTOCOL: u16 = 2;
/// Protocol number with keep-alive, which some controllers use in their answers.
const PROTOCOL_KEEP_ALIVE: u16 = 3;
/// Maximum length of an answer, bytes. Answers to this driver have about 50 bytes. A greater length means lost synchronisation.
const LENGTH_MAX: usize = 1024;
/// Register of messages that the controller sends without a request.
const FEEDBACK: u8 = 0xff;

impl Request {
    /// Encodes the request with the transaction number `transaction`, which the answer repeats.
    pub(super) fn encode(&self, transaction: u16) -> Vec<u8> {
        let length = u16::try_from(1 + self.parameters.len()).unwrap_or(u16::MAX);
        let mut bytes = Vec::with_capacity(HEADER + usize::from(length));
        bytes.extend(transaction.to_be_bytes());
        bytes.extend(PROTOCOL.to_be_bytes());
        bytes.extend(length.to_be_bytes());
        bytes.push(self.register);
        bytes.extend(&self.parameters);
        bytes
    }
}

/// Answer of the controller.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Reply {
    pub(super) transaction: u16,
    pub(super) register: u8,
    pub(super) status: Status,
    pub(super) parameters: Vec<u8>,
}

/// Status of the controller, in one byte of every answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Status(pub(super) u8);

impl Status {
    /// True if the controller has an error that stops it.
    pub(super) fn has_error(self) -> bool {
        self.0 & 0x40 != 0
    }

    /// True if the controller does not know the command or its parameters.
    pub(super) fn is_invalid(self) -> bool {
        self.0 & 0x08 != 0
    }

    /// True if the controller is not ready to move.
    pub(super) fn is_not_ready(self) -> bool {
        self.0 & 0x10 != 0
    }
}

/// Error for an invalid answer. The decoder cannot find the next frame, because frames have no start mark.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
pub(super) enum FrameError {
    #[error("a header of protocol {found:#06x}, expected 2 or 3")]
    Protocol { found: u16 },
    #[error("a header with a length of {found} bytes, expected 2 to {LENGTH_MAX}")]
    Length { found: usize },
}

/// Splits bytes that arrive in pieces of any size into answers.
#[derive(Debug, Default)]
pub(super) struct Replies {
    waiting: Vec<u8>,
}

impl Replies {
    /// Appends received bytes.
    pub(super) fn push(&mut self, bytes: &[u8]) {
        self.waiting.extend_from_slice(bytes);
    }

    /// Returns the next complete answer; `None` until it has arrived. Skips unsolicited messages.
    ///
    /// # Errors
    /// [`FrameError`], which is permanent: the link must be closed.
    pub(super) fn next(&mut self) -> Result<Option<Reply>, FrameError> {
        loop {
            let Some(&[t1, t0, p1, p0, l1, l0]) = self.waiting.first_chunk::<HEADER>() else {
                return Ok(None);
            };
            let protocol = u16::from_be_bytes([p1, p0]);
            if protocol != PROTOCOL && protocol != PROTOCOL_KEEP_ALIVE {
                return Err(FrameError::Protocol { found: protocol });
            }
            let length = usize::from(u16::from_be_bytes([l1, l0]));
            if !(2..=LENGTH_MAX).contains(&length) {
                return Err(FrameError::Length { found: length });
            }
            if self.waiting.len() < HEADER + length {
                return Ok(None);
            }
            let frame: Vec<u8> = self.waiting.drain(..HEADER + length).collect();
            let [register, status] = [frame[HEADER], frame[HEADER + 1]];
            if register != FEEDBACK {
                return Ok(Some(Reply {
                    transaction: u16::from_be_bytes([t1, t0]),
                    register,
                    status: Status(status),
                    parameters: frame[HEADER + 2..].to_vec(),
                }));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Answer to `get_position()` at (300 mm, 0, 300 mm, π rad, 0, 0), in hexadecimal. The public client accepts this answer.
    const POSE: &str = "000a 0003 001a 29 00 00009643 00000000 00009643 db0f4940 00000000 00000000";

    fn bytes(hexadecimal: &str) -> Vec<u8> {
        crate::link::hexadecimal(hexadecimal)
    }

    fn all(replies: &mut Replies) -> Vec<Reply> {
        std::iter::from_fn(|| replies.next().expect("good frames")).collect()
    }

    #[test]
    fn a_request_is_written_as_the_public_client_writes_it() {
        let stop = Request {
            register: 12,
            parameters: vec![4],
        };
        assert_eq!(stop.encode(0x2e), bytes("002e 0002 0002 0c 04"));
        let version = Request {
            register: 1,
            parameters: Vec::new(),
        };
        assert_eq!(version.encode(1), bytes("0001 0002 0001 01"));
    }

    #[test]
    fn answers_are_the_same_however_they_are_split_and_merged() {
        let enabled = bytes("0005 0003 0002 0b 10");
        let stream = [enabled, bytes(POSE), bytes("0006 0002 0003 0d 00 02")].concat();
        let mut at_once = Replies::default();
        at_once.push(&stream);
        let expected = all(&mut at_once);
        assert_eq!(expected.len(), 3);
        assert!(expected[0].status.is_not_ready() && !expected[0].status.has_error());
        assert_eq!(expected[1].transaction, 10);
        assert_eq!(expected[1].parameters.len(), 24);
        for piece in 1..stream.len() {
            let mut replies = Replies::default();
            let mut found = Vec::new();
            for part in stream.chunks(piece) {
                replies.push(part);
                found.extend(all(&mut replies));
            }
            assert_eq!(found, expected, "in pieces of {piece}");
        }
    }

    #[test]
    fn what_was_not_asked_for_is_passed_over() {
        let mut replies = Replies::default();
        replies.push(&bytes("0019 0003 0007 ff 00 02 15 00 00 cc"));
        replies.push(&bytes("001a 0003 0003 0d 00 01"));
        assert_eq!(all(&mut replies).len(), 1);
    }

    #[test]
    fn a_foreign_protocol_and_an_absurd_length_end_the_link_for_good() {
        for (stream, expected) in [
            ("0001 0000 0003 0d 00 01", FrameError::Protocol { found: 0 }),
            (
                "4854 5450 2f31 2e31",
                FrameError::Protocol { found: 0x5450 },
            ),
            ("0001 0002 ffff 0d 00", FrameError::Length { found: 0xffff }),
            ("0001 0002 0001 0d", FrameError::Length { found: 1 }),
            ("0001 0002 0000", FrameError::Length { found: 0 }),
        ] {
            let mut replies = Replies::default();
            replies.push(&bytes(stream));
            assert_eq!(replies.next(), Err(expected.clone()));
            replies.push(&bytes("0002 0002 0003 0d 00 01"));
            assert_eq!(replies.next(), Err(expected));
        }
    }
}
