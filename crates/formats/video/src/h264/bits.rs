//! Bit reader for parameter sets of H.264.

/// Payload of a NAL unit, without emulation prevention bytes.
pub(super) struct Bits {
    bytes: Vec<u8>,
    at: usize,
}

impl Bits {
    /// Reader of the NAL unit `unit`, from its second byte. Removes emulation prevention bytes.
    pub(super) fn new(unit: &[u8]) -> Bits {
        let mut bytes = Vec::with_capacity(unit.len());
        let mut zeros = 0;
        for &byte in unit.iter().skip(1) {
            if zeros >= 2 && byte == 3 {
                zeros = 0;
                continue;
            }
            zeros = if byte == 0 { zeros + 1 } else { 0 };
            bytes.push(byte);
        }
        Bits { bytes, at: 0 }
    }

    pub(super) fn bit(&mut self) -> Option<bool> {
        let byte = self.bytes.get(self.at / 8)?;
        let bit = byte >> (7 - self.at % 8) & 1;
        self.at += 1;
        Some(bit == 1)
    }

    /// Next `count` bits, at most 32; `None` at the end of the unit.
    pub(super) fn bits(&mut self, count: u32) -> Option<u32> {
        (0..count).try_fold(0, |number, _| Some(number << 1 | u32::from(self.bit()?)))
    }

    /// Unsigned Exp-Golomb number, at most 2^32 − 2.
    pub(super) fn unsigned(&mut self) -> Option<u32> {
        let mut zeros = 0;
        while !self.bit()? {
            zeros += 1;
            if zeros > 31 {
                return None;
            }
        }
        let rest = self.bits(zeros)?;
        Some((1_u32 << zeros) - 1 + rest)
    }

    /// Signed Exp-Golomb number: 0, 1, −1, 2, −2 …
    pub(super) fn signed(&mut self) -> Option<i64> {
        let number = i64::from(self.unsigned()?);
        Some(if number % 2 == 1 {
            (number + 1) / 2
        } else {
            -number / 2
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_read_as_the_standard_writes_them() {
        // 1, 010, 011, 00100, 00101: 0, 1, 2, 3, 4 (ITU-T H.264, table 9-2).
        let mut bits = Bits::new(&[0x67, 0b1010_0110, 0b0100_0010, 0b1000_0000]);
        let numbers: Vec<u32> = (0..5).map(|_| bits.unsigned().expect("there")).collect();
        assert_eq!(numbers, [0, 1, 2, 3, 4]);
        let mut bits = Bits::new(&[0x67, 0b1010_0110, 0b0100_0010, 0b1000_0000]);
        let numbers: Vec<i64> = (0..5).map(|_| bits.signed().expect("there")).collect();
        assert_eq!(numbers, [0, 1, -1, 2, -2]);
        assert_eq!(Bits::new(&[0, 0, 0, 0, 0]).unsigned(), None);
    }

    #[test]
    fn bytes_that_keep_start_codes_out_are_left_out() {
        let mut bits = Bits::new(&[0x67, 0, 0, 3, 1]);
        assert_eq!(bits.bits(24), Some(1));
        assert_eq!(bits.bit(), None);
    }
}
