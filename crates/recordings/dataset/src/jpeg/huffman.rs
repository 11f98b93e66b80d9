//! Huffman codes of a table, and their symbols.

use super::bits::{Bits, ENDS_EARLY};

/// Maximum length of a code that one look-up in `quick` decodes, bits.
const QUICK: u32 = 9;

/// A Huffman table for decoding.
#[derive(Clone, Debug)]
pub(super) struct Huffman {
    /// For each value of the next [`QUICK`] bits, the length of the code and its symbol. The length is 0 if the code is longer or invalid.
    quick: Vec<(u8, u8)>,
    /// For each code length, the number after the last code of this length, left-aligned in 16 bits.
    beyond: [u32; 17],
    /// For each code length, the difference between the index of a symbol and its code.
    offset: [i64; 17],
    symbols: Vec<u8>,
}

impl Huffman {
    /// The table with `counts[n]` codes of n + 1 bits.
    pub(super) fn new(counts: &[u8; 16], symbols: &[u8]) -> Result<Huffman, String> {
        let mut table = Huffman {
            quick: vec![(0, 0); 1 << QUICK],
            beyond: [0; 17],
            offset: [0; 17],
            symbols: symbols.to_vec(),
        };
        let (mut code, mut first) = (0_u32, 0_usize);
        for (length, count) in (1_u32..).zip(counts) {
            let count = u32::from(*count);
            if code + count > 1 << length {
                return Err("a Huffman table has too many codes".to_owned());
            }
            let place = length as usize;
            table.offset[place] = first as i64 - i64::from(code);
            for _ in 0..count {
                let symbol = symbols.get(first).ok_or("a Huffman table is truncated")?;
                if length <= QUICK {
                    let shift = QUICK - length;
                    let from = (code << shift) as usize;
                    #[expect(clippy::cast_possible_truncation, reason = "at most nine")]
                    let entry = (length as u8, *symbol);
                    table.quick[from..from + (1 << shift)].fill(entry);
                }
                code += 1;
                first += 1;
            }
            table.beyond[place] = code << (16 - length);
            code <<= 1;
        }
        Ok(table)
    }

    /// The symbol of the next code.
    #[inline]
    pub(super) fn decode(&self, bits: &mut Bits<'_>) -> Result<u8, String> {
        let (next, there) = bits.peek();
        let (length, symbol) = self.quick[(next >> (16 - QUICK)) as usize];
        if length > 0 && u32::from(length) <= there {
            bits.skip(u32::from(length));
            return Ok(symbol);
        }
        for length in 1..=16_u32 {
            if next < self.beyond[length as usize] {
                if length > there {
                    return Err(ENDS_EARLY.to_owned());
                }
                bits.skip(length);
                let code = i64::from(next >> (16 - length));
                let place = usize::try_from(code + self.offset[length as usize]);
                let symbol = place.ok().and_then(|place| self.symbols.get(place));
                return symbol.copied().ok_or_else(no_code);
            }
        }
        Err(if there < 16 {
            ENDS_EARLY.to_owned()
        } else {
            no_code()
        })
    }
}

fn no_code() -> String {
    "the entropy-coded data has a code that is in no table".to_owned()
}
