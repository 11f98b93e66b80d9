//! Layout of one element in a file, and its conversion to values.

mod decoder;

use crate::element::Element;
use crate::error::Problem;

/// Meaning of the bytes of an element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(
    not(feature = "hdf5"),
    expect(dead_code, reason = "some variants occur only in HDF5 files")
)]
pub(crate) enum Kind {
    Bool,
    Unsigned,
    Signed,
    Float,
    /// UTF-8 text with padding.
    Text(Filler),
    /// UTF-32 text padded with zeros.
    WideText,
    /// Reference to text of any length in a heap.
    HeapText,
    /// Reference to bytes of any length in a heap.
    HeapBytes,
}

/// Padding after a text that is shorter than its field.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(
    not(feature = "hdf5"),
    expect(dead_code, reason = "some variants occur only in HDF5 files")
)]
pub(crate) enum Filler {
    Zeros,
    /// The text ends at the first zero; any bytes may follow.
    FirstZero,
    Spaces,
}

/// Stored type of an element: kind, length and byte order.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Scalar {
    kind: Kind,
    bytes: usize,
    is_big_endian: bool,
}

impl Scalar {
    /// Scalar type of `bytes` bytes; `None` if the kind does not exist in this length.
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

    /// Parses a NumPy type such as `<f4`, `|u1`, `>i8`, `|b1`, `|S6` or `<U5`.
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
                    "save the real and the imaginary part as separate arrays",
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

    /// Size of one element of this type, bytes.
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

    /// Bytes of a number; `None` if the element type cannot represent it.
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

    /// Encodes a floating-point number in 32 or 64 bits; `None` for other types.
    pub(crate) fn encode_float(self, number: f64) -> Option<Vec<u8>> {
        match (self.kind, self.bytes) {
            #[expect(
                clippy::cast_possible_truncation,
                reason = "the fill value is the nearest 32-bit number"
            )]
            (Kind::Float, 4) => Some(self.in_order(&(number as f32).to_le_bytes())),
            (Kind::Float, 8) => Some(self.in_order(&number.to_le_bytes())),
            _ => None,
        }
    }

    /// Converts little-endian bytes to the byte order of this type.
    fn in_order(self, little: &[u8]) -> Vec<u8> {
        let mut bytes = little.to_vec();
        if self.is_big_endian {
            bytes.reverse();
        }
        bytes
    }

    /// True for a reference to text, false for a reference to bytes; `None` for other types.
    #[cfg(feature = "hdf5")]
    pub(crate) fn heap_text(self) -> Option<bool> {
        match self.kind {
            Kind::HeapText => Some(true),
            Kind::HeapBytes => Some(false),
            _ => None,
        }
    }
}

/// Shortens untrusted text for a message and escapes control characters.
pub(crate) fn shown(text: &str) -> String {
    let mut short: String = text.chars().take(60).flat_map(char::escape_debug).collect();
    if text.chars().nth(60).is_some() {
        short.push('…');
    }
    short
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
