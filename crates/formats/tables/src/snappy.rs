//! Streaming decoder of the snappy block format.
//!
//! A block has its unpacked length, then elements. An element is a literal or a copy of earlier output. Compressors split their input into pieces of
//! 64 KiB and copy only within a piece. A window of that size is therefore sufficient. A copy from further back is rejected.

use std::io::{self, BufRead, Read};

/// Maximum distance between a copy and its original in the output of snappy, bytes.
const WINDOW: usize = 1 << 16;

/// Streaming decoder of a snappy block.
pub(crate) struct SnappyStream<R> {
    packed: R,
    /// Last part of the output, which is regularly trimmed to the window size. `handed` is the position up to which it was returned.
    window: Vec<u8>,
    handed: usize,
    /// Number of bytes that are not unpacked yet.
    left: usize,
    element: Element,
}

/// Element of a snappy block that is being unpacked.
#[derive(Clone, Copy)]
enum Element {
    Literal(usize),
    Copy { from: usize, length: usize },
}

impl<R: BufRead> SnappyStream<R> {
    /// Creates the decoder of a block, whose unpacked size must be `size` bytes.
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
                "snappy announces {announced} bytes, expected {size}"
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

    /// Reads the next element, whose length is above 0.
    fn next(&mut self) -> io::Result<Element> {
        let mut bytes = [byte(&mut self.packed)?, 0, 0, 0, 0];
        let extra = numbers(bytes[0]);
        self.packed.read_exact(&mut bytes[1..=extra])?;
        let found = element(&bytes, 0).map(|(element, _)| element);
        found.ok_or_else(|| wrong("a snappy element does not fit in memory"))
    }

    /// Unpacks more data into the window.
    fn fill(&mut self) -> io::Result<()> {
        if self.window.len() >= 3 * WINDOW {
            let cut = self.window.len() - WINDOW;
            self.window.drain(..cut);
            self.handed = WINDOW;
        }
        let is_between = matches!(
            self.element,
            Element::Literal(0) | Element::Copy { length: 0, .. }
        );
        if is_between && self.fill_from_buffer()? {
            return Ok(());
        }
        if is_between {
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
                    return Err(wrong("the Snappy block is cut short or too long"));
                }
                *length -= some;
                self.left -= some;
            }
            Element::Copy { from, length } => {
                let length = std::mem::take(length);
                copy(&mut self.window, *from, length, self.left)?;
                self.left -= length;
            }
        }
        Ok(())
    }

    /// Unpacks the complete elements of the input buffer. Returns true if there was an element.
    fn fill_from_buffer(&mut self) -> io::Result<bool> {
        let (packed, window) = (self.packed.fill_buf()?, &mut self.window);
        let (mut at, mut left) = (0, self.left);
        while let (true, Some((element, begin))) =
            (left > 0 && window.len() < 3 * WINDOW, element(packed, at))
        {
            let (from, length) = match element {
                Element::Literal(length) => {
                    let end = begin.checked_add(length);
                    let Some(literal) = end.and_then(|end| packed.get(begin..end)) else {
                        break;
                    };
                    if length > left {
                        return Err(wrong("the Snappy block is longer than it announces"));
                    }
                    window.extend_from_slice(literal);
                    (at, left) = (begin + length, left - length);
                    continue;
                }
                Element::Copy { from, length } => (from, length),
            };
            copy(window, from, length, left)?;
            (at, left) = (begin, left - length);
        }
        self.left = left;
        self.packed.consume(at);
        Ok(at > 0)
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

/// Appends a copy of the `length` bytes that begin `from` bytes before the end of `window`. Fails if `length` exceeds `left`.
fn copy(window: &mut Vec<u8>, from: usize, length: usize, left: usize) -> io::Result<()> {
    let begin = window.len().checked_sub(from).filter(|_| from > 0);
    let Some(begin) = begin.filter(|_| length <= left) else {
        return Err(wrong("a snappy copy is from outside the decompressed data"));
    };
    if length <= from {
        window.extend_from_within(begin..begin + length);
    } else {
        // A copy that overlaps its own output repeats its beginning.
        for at in begin..begin + length {
            window.push(window[at]);
        }
    }
    Ok(())
}

/// Parses the element at the offset `at`. Also returns the offset after its tag and numbers; `None` if `packed` ends within these.
fn element(packed: &[u8], at: usize) -> Option<(Element, usize)> {
    let tag = *packed.get(at)?;
    let high = usize::from(tag >> 2);
    let extra = numbers(tag);
    let begin = at + 1 + extra;
    let mut bytes = [0; 8];
    bytes[..extra].copy_from_slice(packed.get(at + 1..begin)?);
    let number = usize::try_from(u64::from_le_bytes(bytes)).ok()?;
    let element = match tag & 3 {
        0 if extra == 0 => Element::Literal(high + 1),
        0 => Element::Literal(number + 1),
        1 => Element::Copy {
            from: (usize::from(tag >> 5) << 8) | number,
            length: (high & 7) + 4,
        },
        _ => Element::Copy {
            from: number,
            length: high + 1,
        },
    };
    Some((element, begin))
}

fn byte(from: &mut impl BufRead) -> io::Result<u8> {
    let mut byte = [0];
    from.read_exact(&mut byte)?;
    Ok(byte[0])
}

/// Number of bytes after a tag that state the length or the distance of an element.
fn numbers(tag: u8) -> usize {
    match tag & 3 {
        0 => usize::from(tag >> 2).saturating_sub(59),
        1 => 1,
        2 => 2,
        _ => 4,
    }
}

fn wrong(problem: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, problem)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Pseudo-random bytes, in part repetitions of near or far bytes.
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

    /// Unpacks the whole input. Checks that reading through a small buffer gives the same result.
    fn unpacked(packed: &[u8], size: usize) -> Result<Vec<u8>, String> {
        let size = u32::try_from(size).expect("small");
        let read = |mut stream: Box<dyn Read + '_>| {
            let mut bytes = Vec::new();
            let read = stream.read_to_end(&mut bytes);
            read.map(|_| bytes).map_err(|error| error.to_string())
        };
        let small = io::BufReader::with_capacity(7, packed);
        let small = SnappyStream::new(small, size).and_then(|stream| read(Box::new(stream)));
        let whole = SnappyStream::new(packed, size).and_then(|stream| read(Box::new(stream)));
        assert_eq!(small.as_ref().ok(), whole.as_ref().ok());
        whole
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
        // A copy before any output, and a copy from before the start of a block.
        assert!(unpacked(&[4, 0x0d, 0], 4).is_err());
        assert!(unpacked(&[8, 0x00, 7, 0x0d, 2], 8).is_err());
    }
}
