//! Protocol between a parent and the child that decodes AV1. Integers have a fixed size and are little-endian.
//!
//! The parent sends a [`Greeting`], then [`Unit`]s. The child answers each unit before the parent sends the next.

use std::io::{self, Read, Write};

#[cfg(feature = "av1")]
use crate::limits;

/// First bytes that the parent sends. The last byte is the version of the protocol.
const LETTERS: [u8; 8] = *b"tacAV1\x00\x01";

/// First message of the parent: the size that all frames have.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Greeting {
    pub(super) width: u32,
    pub(super) height: u32,
}

/// Packet of one frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Unit {
    /// True if the decoder must be reset first.
    pub(super) is_restart: bool,
    /// True if the child must return the picture.
    pub(super) is_wanted: bool,
    pub(super) bytes: Vec<u8>,
}

/// Answer of the child to a unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Answer {
    /// Packet decoded, but picture not returned. `has_picture` is true if the packet gave a picture.
    Decoded { has_picture: bool },
    /// Packet decoded, with its picture.
    Picture(Yuv),
    /// Packet not decoded, with the reason.
    Refused(String),
}

/// Picture of 8 bits per sample: luma, then two chroma planes with half its width and height unless it is gray.
#[derive(Clone, PartialEq, Eq)]
pub(super) struct Yuv {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) is_gray: bool,
    /// Matrix number of ITU-T H.273; 2 means unspecified.
    pub(super) matrix: u16,
    pub(super) is_full_range: bool,
    pub(super) planes: Vec<u8>,
}

impl std::fmt::Debug for Yuv {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Yuv({}×{})", self.width, self.height)
    }
}

/// Total size of the planes of a picture, bytes. The sides must be within the limits.
pub(super) fn plane_bytes(width: u32, height: u32, is_gray: bool) -> u64 {
    let (width, height) = (u64::from(width), u64::from(height));
    width * height
        + if is_gray {
            0
        } else {
            2 * width.div_ceil(2) * height.div_ceil(2)
        }
}

impl Greeting {
    pub(super) fn write(&self, to: &mut impl Write) -> io::Result<()> {
        to.write_all(&LETTERS)?;
        to.write_all(&self.width.to_le_bytes())?;
        to.write_all(&self.height.to_le_bytes())
    }

    #[cfg(feature = "av1")]
    pub(super) fn read(from: &mut impl Read) -> io::Result<Greeting> {
        if take::<8>(from)? != LETTERS {
            return Err(wrong("the other process is a different program or version"));
        }
        let (width, height) = (
            u32::from_le_bytes(take(from)?),
            u32::from_le_bytes(take(from)?),
        );
        let is_side = |side| (1..=limits::SIDE).contains(&side);
        if !is_side(width)
            || !is_side(height)
            || plane_bytes(width, height, false) > limits::FRAME_BYTES
        {
            return Err(wrong("frame size out of range"));
        }
        Ok(Greeting { width, height })
    }
}

impl Unit {
    pub(super) fn write(&self, to: &mut impl Write) -> io::Result<()> {
        let size = u32::try_from(self.bytes.len()).map_err(|_| wrong("packet too large"))?;
        to.write_all(&size.to_le_bytes())?;
        to.write_all(&[u8::from(self.is_restart) | u8::from(self.is_wanted) << 1])?;
        to.write_all(&self.bytes)
    }

    /// Reads the next unit; `None` at the end of the input.
    #[cfg(feature = "av1")]
    pub(super) fn read(from: &mut impl Read) -> io::Result<Option<Unit>> {
        let mut first = [0];
        if from.read(&mut first)? == 0 {
            return Ok(None);
        }
        let [b, c, d] = take(from)?;
        let size = u32::from_le_bytes([first[0], b, c, d]);
        // A packet after the settings of its stream.
        if u64::from(size) > limits::PACKET_BYTES + limits::HEADER_BYTES {
            return Err(wrong("packet too large"));
        }
        let [flags] = take(from)?;
        let mut bytes = vec![0; size as usize];
        from.read_exact(&mut bytes)?;
        Ok(Some(Unit {
            is_restart: flags & 1 != 0,
            is_wanted: flags & 2 != 0,
            bytes,
        }))
    }
}

/// Size of the header of a picture, bytes.
const PICTURE_HEAD: usize = 12;
/// Maximum length of a reason for a refusal, bytes.
#[cfg(feature = "av1")]
const MOST_WORDS: usize = 1024;

impl Answer {
    #[cfg(feature = "av1")]
    pub(super) fn write(&self, to: &mut impl Write) -> io::Result<()> {
        match self {
            Answer::Decoded { has_picture } => to.write_all(&[b'D', u8::from(*has_picture)]),
            Answer::Picture(yuv) => {
                to.write_all(b"P")?;
                to.write_all(&yuv.width.to_le_bytes())?;
                to.write_all(&yuv.height.to_le_bytes())?;
                to.write_all(&yuv.matrix.to_le_bytes())?;
                to.write_all(&[u8::from(yuv.is_full_range), u8::from(yuv.is_gray)])?;
                to.write_all(&yuv.planes)
            }
            Answer::Refused(words) => {
                let words = &words.as_bytes()[..words.len().min(MOST_WORDS)];
                let length = u16::try_from(words.len()).unwrap_or(0);
                to.write_all(b"R")?;
                to.write_all(&length.to_le_bytes())?;
                to.write_all(words)
            }
        }
    }

    /// Reads the bytes of the next answer, for frames of the size of `greeting`. Returns no bytes at the end of the input.
    pub(super) fn take(from: &mut dyn Read, greeting: Greeting) -> io::Result<Vec<u8>> {
        let mut answer = Vec::new();
        let mut more = |answer: &mut Vec<u8>, count: u64| {
            let wanted = answer.len() as u64 + count;
            from.take(count).read_to_end(answer)?;
            match answer.len() as u64 == wanted {
                true => Ok(()),
                false => Err(io::Error::from(io::ErrorKind::UnexpectedEof)),
            }
        };
        if more(&mut answer, 1).is_err() {
            return Ok(Vec::new());
        }
        match answer[0] {
            b'D' => more(&mut answer, 1)?,
            b'R' => {
                more(&mut answer, 2)?;
                let length = u64::from(u16::from_le_bytes([answer[1], answer[2]]));
                more(&mut answer, length)?;
            }
            b'P' => {
                more(&mut answer, PICTURE_HEAD as u64)?;
                let Some(head) = Yuv::head(&answer) else {
                    return Err(wrong("a picture without a header"));
                };
                // Planes of another size are not read.
                if (head.width, head.height) == (greeting.width, greeting.height) {
                    more(
                        &mut answer,
                        plane_bytes(head.width, head.height, head.is_gray),
                    )?;
                }
            }
            _ => return Err(wrong("an answer of an unknown kind")),
        }
        Ok(answer)
    }

    /// Parses the bytes that [`Answer::take`] returned.
    pub(super) fn parse(mut bytes: Vec<u8>) -> Option<Answer> {
        Some(match *bytes.first()? {
            b'D' => Answer::Decoded {
                has_picture: *bytes.get(1)? != 0,
            },
            b'R' => Answer::Refused(String::from_utf8_lossy(bytes.get(3..)?).into_owned()),
            b'P' => {
                let mut yuv = Yuv::head(&bytes)?;
                bytes.drain(..=PICTURE_HEAD);
                yuv.planes = bytes;
                Answer::Picture(yuv)
            }
            _ => return None,
        })
    }
}

impl Yuv {
    /// Parses the header of a picture, between the first letter of `answer` and the planes.
    fn head(answer: &[u8]) -> Option<Yuv> {
        let head: &[u8; PICTURE_HEAD] = answer.get(1..)?.first_chunk()?;
        let &[
            w0,
            w1,
            w2,
            w3,
            h0,
            h1,
            h2,
            h3,
            m0,
            m1,
            is_full_range,
            is_gray,
        ] = head;
        Some(Yuv {
            width: u32::from_le_bytes([w0, w1, w2, w3]),
            height: u32::from_le_bytes([h0, h1, h2, h3]),
            is_gray: is_gray != 0,
            matrix: u16::from_le_bytes([m0, m1]),
            is_full_range: is_full_range != 0,
            planes: Vec::new(),
        })
    }
}

#[cfg(feature = "av1")]
fn take<const N: usize>(from: &mut impl Read) -> io::Result<[u8; N]> {
    let mut bytes = [0; N];
    from.read_exact(&mut bytes)?;
    Ok(bytes)
}

fn wrong(what: &'static str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, what)
}

#[cfg(all(test, feature = "av1"))]
mod tests {
    use super::*;

    #[test]
    fn what_is_written_is_read_again() {
        let greeting = Greeting {
            width: 3,
            height: 2,
        };
        let unit = Unit {
            is_restart: true,
            is_wanted: false,
            bytes: vec![1, 2, 3],
        };
        let mut bytes = Vec::new();
        greeting.write(&mut bytes).expect("written");
        unit.write(&mut bytes).expect("written");
        let mut from = bytes.as_slice();
        assert_eq!(Greeting::read(&mut from).expect("read"), greeting);
        assert_eq!(Unit::read(&mut from).expect("read"), Some(unit));
        assert_eq!(Unit::read(&mut from).expect("read"), None);

        let yuv = Yuv {
            width: 3,
            height: 2,
            is_gray: false,
            matrix: 6,
            is_full_range: true,
            planes: vec![7; 6 + 4],
        };
        let answers = [
            Answer::Decoded { has_picture: true },
            Answer::Picture(yuv),
            Answer::Refused("no".to_owned()),
        ];
        let mut bytes = Vec::new();
        for answer in &answers {
            answer.write(&mut bytes).expect("written");
        }
        let mut from = bytes.as_slice();
        for answer in answers {
            let taken = Answer::take(&mut from, greeting).expect("taken");
            assert_eq!(Answer::parse(taken), Some(answer));
        }
        assert_eq!(
            Answer::take(&mut from, greeting).expect("the end"),
            Vec::<u8>::new()
        );
    }

    #[test]
    fn nothing_is_allocated_for_a_size_that_is_merely_said() {
        let unit = [0xff, 0xff, 0xff, 0xff, 0];
        assert!(Unit::read(&mut unit.as_slice()).is_err());
        let mut greeting = LETTERS.to_vec();
        greeting.extend([0xff; 8]);
        assert!(Greeting::read(&mut greeting.as_slice()).is_err());
        assert!(Greeting::read(&mut [0; 16].as_slice()).is_err());
    }
}
