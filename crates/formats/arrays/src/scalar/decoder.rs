//! Decoder of stored bytes to values.

use super::{Filler, Kind, Scalar};
use crate::error::Problem;
use crate::source::{ByteSource, bytes_of};
use crate::values::ArrayValues;

/// Number of bytes decoded at once. A piece fits the processor cache, and no second buffer for the whole array is needed.
const PIECE_BYTES: usize = 128 << 10;

impl Scalar {
    /// Reads the `count` elements that begin at `at`.
    pub(crate) fn read(
        self,
        source: &dyn ByteSource,
        at: u64,
        count: usize,
    ) -> Result<ArrayValues, Problem> {
        let bytes = count.saturating_mul(self.bytes) as u64;
        let is_in_pieces = !matches!(
            (self.kind, self.bytes),
            (Kind::Unsigned, 1) | (Kind::Text(_) | Kind::WideText, _)
        ) && bytes > PIECE_BYTES as u64;
        if !is_in_pieces {
            return self.decode(bytes_of(source, at, bytes)?, count);
        }
        // The range is checked before anything is allocated.
        if at
            .checked_add(bytes)
            .is_none_or(|end| end > source.length())
        {
            return bytes_of(source, at, bytes).and_then(|raw| self.decode(raw, count));
        }
        let mut values = ArrayValues::with_capacity(self.element(), count);
        let mut piece = vec![0; PIECE_BYTES / self.bytes * self.bytes];
        let mut done = 0;
        while done < bytes {
            let length = usize::try_from(bytes - done)
                .unwrap_or(usize::MAX)
                .min(piece.len());
            source.read_at(at + done, &mut piece[..length])?;
            self.extend(&mut values, &piece[..length])?;
            done += length as u64;
        }
        Ok(values)
    }

    /// Decodes `count` elements from `raw`.
    pub(crate) fn decode(self, raw: Vec<u8>, count: usize) -> Result<ArrayValues, Problem> {
        debug_assert_eq!(raw.len(), count * self.bytes, "whole elements");
        match self.kind {
            Kind::Unsigned if self.bytes == 1 => Ok(ArrayValues::U8(raw)),
            Kind::Text(filler) => Ok(self.texts_or_bytes(&raw, count, filler)),
            Kind::WideText => {
                let of = if self.is_big_endian {
                    u32::from_be_bytes
                } else {
                    u32::from_le_bytes
                };
                self.texts(&raw, count, |bytes| utf32(bytes, of))
            }
            _ => {
                let mut values = ArrayValues::with_capacity(self.element(), count);
                self.extend(&mut values, &raw)?;
                Ok(values)
            }
        }
    }

    /// Appends the numbers in `raw`.
    fn extend(self, values: &mut ArrayValues, raw: &[u8]) -> Result<(), Problem> {
        /// Appends elements of `N` bytes, converted by `little` or `big` according to the byte order. The function is inlined into the loop.
        fn each<const N: usize, T>(
            all: &mut Vec<T>,
            raw: &[u8],
            is_big_endian: bool,
            little: impl Fn([u8; N]) -> T,
            big: impl Fn([u8; N]) -> T,
        ) {
            let (raw, _) = raw.as_chunks::<N>();
            if is_big_endian {
                all.extend(raw.iter().map(|bytes| big(*bytes)));
            } else {
                all.extend(raw.iter().map(|bytes| little(*bytes)));
            }
        }
        let big = self.is_big_endian;
        match values {
            ArrayValues::Bool(all) => all.extend(raw.iter().map(|byte| *byte != 0)),
            ArrayValues::U8(all) => all.extend_from_slice(raw),
            ArrayValues::I8(all) => all.extend(raw.iter().map(|byte| byte.cast_signed())),
            ArrayValues::U16(all) => each(all, raw, big, u16::from_le_bytes, u16::from_be_bytes),
            ArrayValues::U32(all) => each(all, raw, big, u32::from_le_bytes, u32::from_be_bytes),
            ArrayValues::U64(all) => each(all, raw, big, u64::from_le_bytes, u64::from_be_bytes),
            ArrayValues::I16(all) => each(all, raw, big, i16::from_le_bytes, i16::from_be_bytes),
            ArrayValues::I32(all) => each(all, raw, big, i32::from_le_bytes, i32::from_be_bytes),
            ArrayValues::I64(all) => each(all, raw, big, i64::from_le_bytes, i64::from_be_bytes),
            ArrayValues::F32(all) if self.bytes == 2 => {
                let little = |bytes| widened(u16::from_le_bytes(bytes));
                let large = |bytes| widened(u16::from_be_bytes(bytes));
                each(all, raw, big, little, large);
            }
            ArrayValues::F32(all) => each(all, raw, big, f32::from_le_bytes, f32::from_be_bytes),
            ArrayValues::F64(all) => each(all, raw, big, f64::from_le_bytes, f64::from_be_bytes),
            // The caller resolves references from their heap.
            ArrayValues::Text(_) | ArrayValues::Bytes(_) => {
                return Err(Problem::unsupported(
                    "references to values elsewhere",
                    "write the values themselves",
                ));
            }
        }
        Ok(())
    }

    /// Fields of equal length as texts, or as bytes if any field is not text. h5py writes JPEG files as such fields.
    fn texts_or_bytes(self, raw: &[u8], count: usize, filler: Filler) -> ArrayValues {
        let fields = (0..count).map(|place| {
            let bytes = &raw[place * self.bytes..(place + 1) * self.bytes];
            &bytes[..length_of(bytes, filler)]
        });
        let texts = fields.clone().map(|field| std::str::from_utf8(field));
        match texts.map(|text| text.map(str::to_owned)).collect() {
            Ok(texts) => ArrayValues::Text(texts),
            Err(_) => ArrayValues::Bytes(fields.map(<[u8]>::to_vec).collect()),
        }
    }

    fn texts(
        self,
        raw: &[u8],
        count: usize,
        read: impl Fn(&[u8]) -> Option<String>,
    ) -> Result<ArrayValues, Problem> {
        let element = |place: usize| {
            let bytes = &raw[place * self.bytes..(place + 1) * self.bytes];
            read(bytes).ok_or_else(|| {
                Problem::unsupported(
                    format!("element {place} of these rows is not UTF-8"),
                    "write strings as UTF-8",
                )
            })
        };
        Ok(ArrayValues::Text(
            (0..count).map(element).collect::<Result<_, _>>()?,
        ))
    }
}

/// Length of the text before the padding, bytes.
fn length_of(bytes: &[u8], filler: Filler) -> usize {
    let up_to_last = |filled: u8| {
        bytes
            .iter()
            .rposition(|byte| *byte != filled)
            .map_or(0, |last| last + 1)
    };
    match filler {
        Filler::Zeros => up_to_last(0),
        Filler::FirstZero => bytes
            .iter()
            .position(|byte| *byte == 0)
            .unwrap_or(bytes.len()),
        Filler::Spaces => up_to_last(b' '),
    }
}

/// Decodes UTF-32 up to the zero padding. `of` reads a code in the byte order of the type.
fn utf32(bytes: &[u8], of: fn([u8; 4]) -> u32) -> Option<String> {
    let (codes, _) = bytes.as_chunks::<4>();
    let end = codes
        .iter()
        .rposition(|code| *code != [0; 4])
        .map_or(0, |last| last + 1);
    codes[..end]
        .iter()
        .map(|code| char::from_u32(of(*code)))
        .collect()
}

/// Converts an IEEE 754 number of 16 bits to 32 bits, exactly.
fn widened(half: u16) -> f32 {
    let sign = u32::from(half >> 15) << 31;
    let exponent = u32::from(half >> 10) & 0x1f;
    let fraction = u32::from(half) & 0x3ff;
    let bits = match (exponent, fraction) {
        (0, 0) => 0,
        (0, _) => {
            // Subnormal: the highest set bit becomes the hidden bit.
            let shift = fraction.leading_zeros() - 21;
            ((113 - shift) << 23) | ((fraction << (shift + 13)) & 0x007f_ffff)
        }
        (0x1f, _) => 0x7f80_0000 | (fraction << 13),
        _ => ((exponent + 112) << 23) | (fraction << 13),
    };
    f32::from_bits(sign | bits)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_are_widened_exactly() {
        for (half, expected) in [
            (0x3c00, 1.0),
            (0xc000, -2.0),
            (0x3555, 0.333_251_95),
            (0x7bff, 65504.0),
            (0x0001, 2.0_f32.powi(-24)),
            (0x03ff, 1023.0 * 2.0_f32.powi(-24)),
            (0x0400, 2.0_f32.powi(-14)),
            (0x8000, -0.0),
            (0x7c00, f32::INFINITY),
        ] {
            assert_eq!(widened(half).to_bits(), expected.to_bits(), "{half:#06x}");
        }
        assert!(widened(0x7e00).is_nan());
    }

    #[test]
    fn text_ends_before_the_zeros_that_fill_it() {
        let plain = Scalar::from_numpy("|S4").expect("known");
        let values = plain
            .decode(b"ab\0\0\xc3\xbcx\0".to_vec(), 2)
            .expect("UTF-8");
        assert_eq!(values, ArrayValues::Text(vec!["ab".into(), "üx".into()]));
        let values = plain
            .decode(vec![0xff, 0xd8, 0, 0, b'a', 0, 0, 0], 2)
            .expect("bytes");
        assert_eq!(
            values,
            ArrayValues::Bytes(vec![vec![0xff, 0xd8], b"a".to_vec()])
        );
        let wide = Scalar::from_numpy(">U2").expect("known");
        let values = wide
            .decode(vec![0, 0, 0x4e, 0x2d, 0, 0, 0, 0], 1)
            .expect("UTF-32");
        assert_eq!(values, ArrayValues::Text(vec!["中".into()]));
        assert!(wide.decode(vec![0, 0, 0xd8, 0, 0, 0, 0, 0], 1).is_err());
        let empty = Scalar::from_numpy("<U0").expect("known");
        assert_eq!(empty.decode(Vec::new(), 3).expect("empty").len(), 3);
    }
}
