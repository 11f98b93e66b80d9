//! How one element lies in a file, and how its bytes become values.

use crate::element::Element;
use crate::error::Problem;
use crate::values::ArrayValues;

/// What the bytes of an element mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Bool,
    Unsigned,
    Signed,
    Float,
    /// UTF-8, filled up.
    Text(Filler),
    /// UTF-32, filled with zeros.
    WideText,
    /// A reference to text of any length.
    HeapText,
    /// A reference to bytes of any length.
    HeapBytes,
}

/// What follows a text in a field that is longer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Filler {
    Zeros,
    /// A zero, and anything behind it.
    FirstZero,
    Spaces,
}

/// The type of an element as it is stored: what, how long, in which byte order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Scalar {
    kind: Kind,
    bytes: usize,
    is_big_endian: bool,
}

impl Scalar {
    /// `None` where the length is none that the kind has.
    pub(crate) fn new(kind: Kind, bytes: usize, is_big_endian: bool) -> Option<Scalar> {
        let is_known = match kind {
            Kind::Bool => bytes == 1,
            Kind::Unsigned | Kind::Signed => matches!(bytes, 1 | 2 | 4 | 8),
            Kind::Float => matches!(bytes, 2 | 4 | 8),
            Kind::Text(_) | Kind::HeapText | Kind::HeapBytes => true,
            Kind::WideText => bytes.is_multiple_of(4),
        };
        is_known.then_some(Scalar {
            kind,
            bytes,
            is_big_endian,
        })
    }

    /// The type that NumPy writes as `<f4`, `|u1`, `>i8`, `|b1`, `|S6` or `<U5`.
    pub(crate) fn from_numpy(name: &str) -> Result<Scalar, Problem> {
        let unknown =
            |mend: &str| Problem::unsupported(format!("elements of type `{}`", shown(name)), mend);
        let mut letters = name.chars();
        let first = letters.next().unwrap_or(' ');
        let (is_big_endian, rest) = match first {
            '<' | '|' => (false, letters.as_str()),
            '=' => (cfg!(target_endian = "big"), letters.as_str()),
            '>' => (true, letters.as_str()),
            _ => (false, name),
        };
        let mut letters = rest.chars();
        let kind = match letters.next() {
            Some('b') => Kind::Bool,
            Some('u') => Kind::Unsigned,
            Some('i') => Kind::Signed,
            Some('f') => Kind::Float,
            Some('S' | 'a') => Kind::Text(Filler::Zeros),
            Some('U') => Kind::WideText,
            Some('c') => {
                return Err(unknown(
                    "save the real and the imaginary part as arrays of their own",
                ));
            }
            Some('M' | 'm') => {
                return Err(unknown(
                    "save times as numbers, for instance `x.astype('int64')`",
                ));
            }
            Some('O') => return Err(unknown("save numbers: `np.asarray(x, dtype=float)`")),
            _ => {
                return Err(unknown(
                    "expected one of b1, u1 to u8, i1 to i8, f2 to f8, S and U",
                ));
            }
        };
        let size = letters.as_str().parse::<usize>().ok();
        let size = size.and_then(|size| match kind {
            Kind::WideText => size.checked_mul(4),
            _ => Some(size),
        });
        size.and_then(|bytes| Scalar::new(kind, bytes, is_big_endian))
            .ok_or_else(|| unknown("expected one of b1, u1 to u8, i1 to i8, f2 to f8, S and U"))
    }

    /// Bytes of one element.
    pub(crate) fn bytes(self) -> usize {
        self.bytes
    }

    pub(crate) fn element(self) -> Element {
        let bits = u8::try_from(self.bytes.saturating_mul(8)).unwrap_or(u8::MAX);
        match self.kind {
            Kind::Bool => Element::Bool,
            Kind::Unsigned => Element::Unsigned(bits),
            Kind::Signed => Element::Signed(bits),
            Kind::Float => Element::Float(bits),
            Kind::Text(_) | Kind::WideText | Kind::HeapText => Element::Text,
            Kind::HeapBytes => Element::Bytes,
        }
    }

    /// The bytes of a number, if it is one that such an element can be.
    pub(crate) fn encode(self, number: &serde_json::Number) -> Option<Vec<u8>> {
        if self.kind == Kind::Float {
            return self.encode_float(number.as_f64()?);
        }
        let (bytes, filler) = match self.kind {
            Kind::Unsigned | Kind::Bool => (number.as_u64()?.to_le_bytes(), 0),
            Kind::Signed => {
                let number = number.as_i64()?;
                (number.to_le_bytes(), if number < 0 { 0xff } else { 0 })
            }
            _ => return None,
        };
        let (kept, dropped) = bytes.split_at_checked(self.bytes)?;
        dropped
            .iter()
            .all(|byte| *byte == filler)
            .then(|| self.in_order(kept))
    }

    /// The same for a number with a floating point of 32 or 64 bits.
    pub(crate) fn encode_float(self, number: f64) -> Option<Vec<u8>> {
        match (self.kind, self.bytes) {
            #[expect(
                clippy::cast_possible_truncation,
                reason = "the nearest of 32 bits is what was filled in"
            )]
            (Kind::Float, 4) => Some(self.in_order(&(number as f32).to_le_bytes())),
            (Kind::Float, 8) => Some(self.in_order(&number.to_le_bytes())),
            _ => None,
        }
    }

    /// Little-endian bytes in the order of this type.
    fn in_order(self, little: &[u8]) -> Vec<u8> {
        let mut bytes = little.to_vec();
        if self.is_big_endian {
            bytes.reverse();
        }
        bytes
    }

    /// Of a reference to a value elsewhere: whether that is text.
    pub(crate) fn heap_text(self) -> Option<bool> {
        match self.kind {
            Kind::HeapText => Some(true),
            Kind::HeapBytes => Some(false),
            _ => None,
        }
    }

    /// The `count` elements that `raw` holds.
    pub(crate) fn decode(self, raw: Vec<u8>, count: usize) -> Result<ArrayValues, Problem> {
        debug_assert_eq!(raw.len(), count * self.bytes, "whole elements");
        /// What makes an element of its bytes, little-endian and big-endian.
        type InEitherOrder<const N: usize, T> = (fn([u8; N]) -> T, fn([u8; N]) -> T);
        /// Elements of `N` bytes, each made by one of the two functions.
        fn each<const N: usize, T>(
            raw: &[u8],
            is_big_endian: bool,
            (little, big): InEitherOrder<N, T>,
        ) -> Vec<T> {
            let (all, _) = raw.as_chunks::<N>();
            if is_big_endian {
                all.iter().map(|bytes| big(*bytes)).collect()
            } else {
                all.iter().map(|bytes| little(*bytes)).collect()
            }
        }
        let big = self.is_big_endian;
        Ok(match (self.kind, self.bytes) {
            (Kind::Bool, _) => ArrayValues::Bool(raw.iter().map(|byte| *byte != 0).collect()),
            (Kind::Unsigned, 1) => ArrayValues::U8(raw),
            (Kind::Unsigned, 2) => {
                ArrayValues::U16(each(&raw, big, (u16::from_le_bytes, u16::from_be_bytes)))
            }
            (Kind::Unsigned, 4) => {
                ArrayValues::U32(each(&raw, big, (u32::from_le_bytes, u32::from_be_bytes)))
            }
            (Kind::Unsigned, _) => {
                ArrayValues::U64(each(&raw, big, (u64::from_le_bytes, u64::from_be_bytes)))
            }
            (Kind::Signed, 1) => {
                ArrayValues::I8(raw.iter().map(|byte| byte.cast_signed()).collect())
            }
            (Kind::Signed, 2) => {
                ArrayValues::I16(each(&raw, big, (i16::from_le_bytes, i16::from_be_bytes)))
            }
            (Kind::Signed, 4) => {
                ArrayValues::I32(each(&raw, big, (i32::from_le_bytes, i32::from_be_bytes)))
            }
            (Kind::Signed, _) => {
                ArrayValues::I64(each(&raw, big, (i64::from_le_bytes, i64::from_be_bytes)))
            }
            (Kind::Float, 2) => {
                let halves = each(&raw, big, (u16::from_le_bytes, u16::from_be_bytes));
                ArrayValues::F32(halves.into_iter().map(widened).collect())
            }
            (Kind::Float, 4) => {
                ArrayValues::F32(each(&raw, big, (f32::from_le_bytes, f32::from_be_bytes)))
            }
            (Kind::Float, _) => {
                ArrayValues::F64(each(&raw, big, (f64::from_le_bytes, f64::from_be_bytes)))
            }
            (Kind::Text(filler), _) => self.texts(&raw, count, |bytes| utf8(bytes, filler))?,
            (Kind::WideText, _) => {
                let of = if big {
                    u32::from_be_bytes
                } else {
                    u32::from_le_bytes
                };
                self.texts(&raw, count, |bytes| utf32(bytes, of))?
            }
            // Whoever lists such elements reads them from its heap.
            (Kind::HeapText | Kind::HeapBytes, _) => {
                return Err(Problem::unsupported(
                    "references to values elsewhere",
                    "write the values themselves",
                ));
            }
        })
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
                    format!("element {place} of these rows is no text of Unicode"),
                    "write texts as UTF-8",
                )
            })
        };
        Ok(ArrayValues::Text(
            (0..count).map(element).collect::<Result<_, _>>()?,
        ))
    }
}

/// What foreign text looks like in a message: cut, and without control characters.
pub(crate) fn shown(text: &str) -> String {
    let mut short: String = text.chars().take(60).flat_map(char::escape_debug).collect();
    if text.chars().nth(60).is_some() {
        short.push('…');
    }
    short
}

/// UTF-8 up to what fills the field.
fn utf8(bytes: &[u8], filler: Filler) -> Option<String> {
    let up_to_last = |filled: u8| {
        bytes
            .iter()
            .rposition(|byte| *byte != filled)
            .map_or(0, |last| last + 1)
    };
    let end = match filler {
        Filler::Zeros => up_to_last(0),
        Filler::FirstZero => bytes
            .iter()
            .position(|byte| *byte == 0)
            .unwrap_or(bytes.len()),
        Filler::Spaces => up_to_last(b' '),
    };
    std::str::from_utf8(&bytes[..end]).ok().map(str::to_owned)
}

/// UTF-32 up to the zeros that fill the field.
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

/// An IEEE 754 number of 16 bits as one of 32, which is exact.
fn widened(half: u16) -> f32 {
    let sign = u32::from(half >> 15) << 31;
    let exponent = u32::from(half >> 10) & 0x1f;
    let fraction = u32::from(half) & 0x3ff;
    let bits = match (exponent, fraction) {
        (0, 0) => 0,
        (0, _) => {
            // Subnormal: the highest set bit becomes the hidden one.
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
    fn names_of_numpy_are_understood_and_others_refused_with_what_to_do() {
        assert_eq!(
            Scalar::from_numpy(">u2").expect("known").element(),
            Element::Unsigned(16)
        );
        assert_eq!(Scalar::from_numpy("<U5").expect("known").bytes(), 20);
        for (name, expected) in [
            ("<c8", "imaginary"),
            ("<M8[ns]", "as numbers"),
            ("|O", "np.asarray"),
            ("<f16", "expected one of"),
            ("<u3", "expected one of"),
            ("", "expected one of"),
            ("<U18446744073709551615", "expected one of"),
        ] {
            let message = Scalar::from_numpy(name).expect_err(name).to_string();
            assert!(message.contains(expected), "{message}");
        }
    }

    #[test]
    fn text_ends_before_the_zeros_that_fill_it() {
        let plain = Scalar::from_numpy("|S4").expect("known");
        let values = plain
            .decode(b"ab\0\0\xc3\xbcx\0".to_vec(), 2)
            .expect("UTF-8");
        assert_eq!(values, ArrayValues::Text(vec!["ab".into(), "üx".into()]));
        assert!(plain.decode(vec![0xff; 4], 1).is_err());
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
