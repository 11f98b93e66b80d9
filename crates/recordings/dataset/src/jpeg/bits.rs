//! Bit reader of entropy-coded data up to the next marker.

/// Reader of the bits between two markers.
#[derive(Debug)]
pub(super) struct Bits<'a> {
    bytes: &'a [u8],
    /// Offset of the next byte to load into `buffer`.
    position: usize,
    /// Loaded but unused bits, in the low end.
    buffer: u64,
    count: u32,
    /// True if `position` is at a marker, or at the end of the file.
    is_at_marker: bool,
}

/// Message about data that ends before the last block.
pub(super) const ENDS_EARLY: &str = "the entropy-coded data ends before the last block";

impl<'a> Bits<'a> {
    pub(super) fn new(bytes: &'a [u8], position: usize) -> Bits<'a> {
        Bits {
            bytes,
            position,
            buffer: 0,
            count: 0,
            is_at_marker: false,
        }
    }

    /// Fills the buffer until it is full or at a marker.
    fn fill(&mut self) {
        while self.count <= 56 && !self.is_at_marker {
            let Some(byte) = self.bytes.get(self.position).copied() else {
                self.is_at_marker = true;
                return;
            };
            if byte == 0xFF {
                let rest = &self.bytes[self.position + 1..];
                let fills = rest.iter().take_while(|byte| **byte == 0xFF).count();
                if rest.get(fills) != Some(&0) {
                    self.is_at_marker = true;
                    return;
                }
                // A stuffed zero: the byte before it is data.
                self.position += fills + 1;
            }
            self.position += 1;
            self.buffer = self.buffer << 8 | u64::from(byte);
            self.count += 8;
        }
    }

    /// The next 16 bits, padded with zeros at the end of the data, and the number of valid bits.
    #[inline]
    pub(super) fn peek(&mut self) -> (u32, u32) {
        if self.count < 16 {
            self.fill();
        }
        let bits = match self.count {
            16.. => self.buffer >> (self.count - 16),
            count => self.buffer << (16 - count),
        };
        let bits = (bits & 0xFFFF) as u32;
        (bits, self.count.min(16))
    }

    /// Skips bits that [`peek`](Bits::peek) reported as valid.
    #[inline]
    pub(super) fn skip(&mut self, count: u32) {
        self.count -= count;
    }

    /// The next `count` bits, at most 16, as a number.
    #[inline]
    pub(super) fn take(&mut self, count: u32) -> Result<u32, String> {
        if count == 0 {
            return Ok(0);
        }
        let (bits, there) = self.peek();
        if count > there {
            return Err(ENDS_EARLY.to_owned());
        }
        self.skip(count);
        Ok(bits >> (16 - count))
    }

    /// Position of the marker that must follow the padding bits.
    pub(super) fn end(mut self) -> Result<usize, String> {
        self.fill();
        if self.count < 8 && self.is_at_marker {
            Ok(self.position)
        } else {
            Err("bytes are left between the last block and the next marker".to_owned())
        }
    }
}

/// The number in `bytes`, big-endian.
pub(super) fn big_endian(bytes: &[u8]) -> usize {
    bytes
        .iter()
        .fold(0, |number, byte| number << 8 | usize::from(*byte))
}
