//! The block format of snappy, unpacked as it is read.
//!
//! A block is a length, then elements: literals, and copies of what was unpacked before. Programs that pack divide their input into pieces of 64 KiB
//! and copy from inside a piece, so that a window of that size holds all that is needed; a copy from further back is refused.

use std::io::{self, BufRead, Read};

/// How far back copies reach.
const WINDOW: usize = 1 << 16;

/// A block that is unpacked as it is read.
pub(crate) struct SnappyStream<R> {
    packed: R,
    /// What was unpacked last, and up to where it was handed on; cut back to a window now and then.
    window: Vec<u8>,
    handed: usize,
    /// Bytes that are not unpacked yet.
    left: usize,
    element: Element,
}

/// The element that is being unpacked.
#[derive(Clone, Copy)]
enum Element {
    Literal(usize),
    Copy { from: usize, length: usize },
}

impl<R: BufRead> SnappyStream<R> {
    /// A block that announces `size` bytes.
    pub(crate) fn new(mut packed: R, size: u32) -> Result<SnappyStream<R>, String> {
        let mut announced = 0_u64;
        for shift in (0..35).step_by(7) {
            let byte = byte(&mut packed).map_err(|error| error.to_string())?;
            announced |= u64::from(byte & 0x7f) << shift;
            if byte & 0x80 == 0 {
                break;
            }
        }
        if announced != u64::from(size) {
            return Err(format!(
                "snappy announces {announced} bytes instead of {size}"
            ));
        }
        Ok(SnappyStream {
            packed,
            window: Vec::with_capacity(4 * WINDOW),
            handed: 0,
            left: size as usize,
            element: Element::Literal(0),
        })
    }

    /// The next element; its length is more than 0.
    fn next(&mut self) -> io::Result<Element> {
        let tag = byte(&mut self.packed)?;
        let high = usize::from(tag >> 2);
        Ok(match tag & 3 {
            0 if high < 60 => Element::Literal(high + 1),
            0 => Element::Literal(number(&mut self.packed, high - 59)? + 1),
            1 => Element::Copy {
                from: (usize::from(tag >> 5) << 8) | number(&mut self.packed, 1)?,
                length: (high & 7) + 4,
            },
            2 => Element::Copy {
                from: number(&mut self.packed, 2)?,
                length: high + 1,
            },
            _ => Element::Copy {
                from: number(&mut self.packed, 4)?,
                length: high + 1,
            },
        })
    }

    /// Unpacks some more into the window.
    fn fill(&mut self) -> io::Result<()> {
        if self.window.len() >= 3 * WINDOW {
            let cut = self.window.len() - WINDOW;
            self.window.drain(..cut);
            self.handed = WINDOW;
        }
        if let Element::Literal(0) | Element::Copy { length: 0, .. } = self.element {
            self.element = self.next()?;
        }
        match &mut self.element {
            Element::Literal(length) => {
                let some = (*length).min(WINDOW).min(self.left);
                let read = self
                    .packed
                    .by_ref()
                    .take(some as u64)
                    .read_to_end(&mut self.window)?;
                if read < some || some == 0 {
                    return Err(wrong("the snappy is cut short, or too long"));
                }
                *length -= some;
                self.left -= some;
            }
            Element::Copy { from, length } => {
                let begin = self.window.len().checked_sub(*from).filter(|_| *from > 0);
                let Some(begin) = begin.filter(|_| *length <= self.left) else {
                    return Err(wrong("a copy of snappy from outside of what was unpacked"));
                };
                self.left -= *length;
                // A copy may reach into itself, which repeats what it begins with.
                for at in begin..begin + std::mem::take(length) {
                    self.window.push(self.window[at]);
                }
            }
        }
        Ok(())
    }
}

impl<R: BufRead> Read for SnappyStream<R> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        if self.handed == self.window.len() {
            if self.left == 0 || into.is_empty() {
                return Ok(0);
            }
            self.fill()?;
        }
        let ready = &self.window[self.handed..];
        let some = ready.len().min(into.len());
        into[..some].copy_from_slice(&ready[..some]);
        self.handed += some;
        Ok(some)
    }
}

fn byte(from: &mut impl BufRead) -> io::Result<u8> {
    let mut byte = [0];
    from.read_exact(&mut byte)?;
    Ok(byte[0])
}

/// A number of so many bytes, the lowest first.
fn number(from: &mut impl BufRead, bytes: usize) -> io::Result<usize> {
    let mut number = [0; 8];
    from.read_exact(&mut number[..bytes.min(4)])?;
    usize::try_from(u64::from_le_bytes(number)).map_err(io::Error::other)
}

fn wrong(problem: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, problem)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Bytes that repeat near and far, and some that do not.
    fn drawn(length: usize, mut seed: u64) -> Vec<u8> {
        let mut bytes: Vec<u8> = Vec::with_capacity(length);
        while bytes.len() < length {
            seed ^= seed << 13;
            seed ^= seed >> 7;
            seed ^= seed << 17;
            let [kind, value, low, high, ..] = seed.to_le_bytes();
            let from = usize::from(low) << (high % 9);
            let count = usize::from(value) + 1;
            match (kind % 3, bytes.len().checked_sub(from + 1)) {
                (0, Some(begin)) => (begin..begin + count).for_each(|at| bytes.push(bytes[at])),
                (1, _) => bytes.extend(std::iter::repeat_n(value, count)),
                _ => bytes.extend_from_slice(&seed.to_be_bytes()),
            }
        }
        bytes.truncate(length);
        bytes
    }

    fn unpacked(packed: &[u8], size: usize) -> Result<Vec<u8>, String> {
        let mut bytes = Vec::new();
        let size = u32::try_from(size).expect("small");
        SnappyStream::new(packed, size)?
            .read_to_end(&mut bytes)
            .map_err(|error| error.to_string())?;
        Ok(bytes)
    }

    #[test]
    fn what_the_crate_packs_is_unpacked() {
        for length in [0, 1, 59, 60, 61, 5_000, 65_535, 65_536, 65_537, 700_000] {
            for bytes in [
                drawn(length, 0x9e37_79b9),
                drawn(length, 77),
                vec![0; length],
            ] {
                let packed = snap::raw::Encoder::new()
                    .compress_vec(&bytes)
                    .expect("packs");
                assert!(unpacked(&packed, length) == Ok(bytes), "{length}");
            }
        }
    }

    #[test]
    fn damaged_blocks_are_errors_and_never_longer_than_announced() {
        let bytes = drawn(20_000, 5);
        let packed = snap::raw::Encoder::new()
            .compress_vec(&bytes)
            .expect("packs");
        for cut in (0..packed.len()).step_by(37) {
            assert!(unpacked(&packed[..cut], bytes.len()).is_err(), "{cut}");
        }
        for at in 0..packed.len().min(3_000) {
            let mut changed = packed.clone();
            changed[at] ^= 1 << (at % 8);
            if let Ok(bytes) = unpacked(&changed, bytes.len()) {
                assert_eq!(bytes.len(), 20_000);
            }
        }
        assert!(unpacked(&packed, 19_999).is_err());
        // A copy before anything was unpacked, and one from further back than a block begins.
        assert!(unpacked(&[4, 0x0d, 0], 4).is_err());
        assert!(unpacked(&[8, 0x00, 7, 0x0d, 2], 8).is_err());
    }
}
