//! Decoder of levels in the hybrid encoding of Parquet: runs of one value, and bit-packed values.

/// Iterator over the definition or repetition levels of a Parquet page.
#[derive(Debug)]
pub(super) struct Levels {
    bytes: Vec<u8>,
    at: usize,
    width: u32,
    run: Run,
}

#[derive(Clone, Copy, Debug)]
enum Run {
    /// Run of `value`, with the number of its remaining repetitions.
    Same { left: u64, value: u32 },
    /// Bit-packed values: the number of remaining values, and the bit offset of the next value.
    Packed { left: u64, bit: u64 },
}

impl Levels {
    /// Creates the decoder of `bytes`, whose levels are from 0 to `highest`.
    pub(super) fn new(bytes: Vec<u8>, highest: i16) -> Levels {
        Levels {
            bytes,
            at: 0,
            width: u32::from(highest.max(0).cast_unsigned())
                .checked_ilog2()
                .map_or(0, |bits| bits + 1),
            run: Run::Same { left: 0, value: 0 },
        }
    }

    /// The next level; `None` at the end of the bytes.
    pub(super) fn next(&mut self) -> Option<u32> {
        loop {
            match &mut self.run {
                Run::Same { left: 0, .. } | Run::Packed { left: 0, .. } => {
                    self.run = self.begin()?
                }
                Run::Same { left, value } => {
                    *left -= 1;
                    return Some(*value);
                }
                Run::Packed { left, bit } => {
                    *left -= 1;
                    let first = *bit;
                    *bit += u64::from(self.width);
                    return self.packed(first);
                }
            }
        }
    }

    fn begin(&mut self) -> Option<Run> {
        let head = self.varint()?;
        if head & 1 == 1 {
            // Groups of eight values of `width` bits each take `width` bytes.
            let groups = head >> 1;
            let first = self.at as u64 * 8;
            let length = usize::try_from(groups.checked_mul(self.width.into())?).ok()?;
            self.at = self.at.checked_add(length)?.min(self.bytes.len());
            return Some(Run::Packed {
                left: groups.checked_mul(8)?,
                bit: first,
            });
        }
        let mut value = 0;
        for byte in 0..self.width.div_ceil(8) {
            value |= u32::from(*self.bytes.get(self.at)?) << (8 * byte);
            self.at += 1;
        }
        Some(Run::Same {
            left: head >> 1,
            value,
        })
    }

    fn packed(&self, first: u64) -> Option<u32> {
        let mut value = 0;
        for bit in 0..self.width {
            let at = first + u64::from(bit);
            let byte = *self.bytes.get(usize::try_from(at / 8).ok()?)?;
            value |= u32::from((byte >> (at % 8)) & 1) << bit;
        }
        Some(value)
    }

    fn varint(&mut self) -> Option<u64> {
        let mut number = 0_u64;
        for shift in (0..63).step_by(7) {
            let byte = *self.bytes.get(self.at)?;
            self.at += 1;
            number |= u64::from(byte & 0x7f) << shift;
            if byte & 0x80 == 0 {
                return Some(number);
            }
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(bytes: &[u8], highest: i16, most: usize) -> Vec<u32> {
        let mut levels = Levels::new(bytes.to_vec(), highest);
        std::iter::from_fn(|| levels.next()).take(most).collect()
    }

    #[test]
    fn runs_and_packed_values_follow_one_another() {
        // Three times 2, then eight packed in two bits each: 0 1 2 3 0 1 2 3.
        assert_eq!(
            all(&[6, 2, 3, 0xe4, 0xe4], 3, 99),
            [2, 2, 2, 0, 1, 2, 3, 0, 1, 2, 3]
        );
        assert_eq!(all(&[3, 0b0101_0011], 1, 99), [1, 1, 0, 0, 1, 0, 1, 0]);
        // The last group may be truncated where its values are not needed.
        assert_eq!(all(&[5, 0xff], 1, 99), [1; 8]);
        assert!(
            all(
                &[0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 0x80, 1],
                1,
                99
            )
            .is_empty()
        );
        assert_eq!(all(&[0xfe, 0xff, 0xff, 0xff, 0x7f, 1], 1, 5), [1; 5]);
        assert!(all(&[0, 1, 0, 1], 1, 9).is_empty());
    }
}
