//! Bit writer for deflate streams. The lowest bit of each number comes first.

/// Bit string of at most 16 bits.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Bits {
    value: u16,
    pub(super) count: u8,
}

impl Bits {
    /// The lowest `count` bits of `value`. All other bits of `value` must be zero.
    pub(super) const fn new(value: u16, count: u8) -> Bits {
        Bits { value, count }
    }
}

/// Bit writer to a buffer of known length.
#[derive(Debug)]
pub(super) struct BitWriter {
    bytes: Vec<u8>,
    length: usize,
    held: u64,
    held_bits: u32,
}

impl BitWriter {
    /// Writer that appends at most `more` bytes to `bytes`.
    pub(super) fn behind(mut bytes: Vec<u8>, more: usize) -> BitWriter {
        let length = bytes.len();
        // Each store writes eight bytes. Bytes after the current end do not count yet.
        bytes.resize(length + more + size_of::<u64>(), 0);
        BitWriter {
            bytes,
            length,
            held: 0,
            held_bits: 0,
        }
    }

    pub(super) fn put(&mut self, bits: Bits) {
        self.hold(bits);
        self.store();
    }

    /// Writes the code words of `symbols`. Each word has at most 15 bits.
    pub(super) fn put_words(&mut self, words: &[Bits; 256], symbols: &[u8]) {
        // Three words and less than a byte that is held already fit into 64 bits.
        let (threes, rest) = symbols.as_chunks::<3>();
        for three in threes {
            for symbol in three {
                self.hold(words[usize::from(*symbol)]);
            }
            self.store();
        }
        for symbol in rest {
            self.put(words[usize::from(*symbol)]);
        }
    }

    /// Pads with zeros to the next byte, then writes `bytes`.
    pub(super) fn put_bytes(&mut self, bytes: &[u8]) {
        self.held_bits = self.held_bits.next_multiple_of(u8::BITS);
        self.store();
        let end = self.length + bytes.len();
        self.bytes[self.length..end].copy_from_slice(bytes);
        self.length = end;
    }

    pub(super) fn finish(mut self) -> Vec<u8> {
        self.bytes.truncate(self.length);
        self.bytes
    }

    fn hold(&mut self, bits: Bits) {
        self.held |= u64::from(bits.value) << self.held_bits;
        self.held_bits += u32::from(bits.count);
    }

    /// Moves the complete bytes of the bit buffer to the output.
    fn store(&mut self) {
        let bytes = self.held.to_le_bytes();
        self.bytes[self.length..self.length + bytes.len()].copy_from_slice(&bytes);
        self.length += (self.held_bits / u8::BITS) as usize;
        self.held >>= self.held_bits & !7;
        self.held_bits &= 7;
    }
}
