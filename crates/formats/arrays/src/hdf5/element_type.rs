//! Types of elements that the writer supports.

/// Type of the elements of a written array, little-endian.
///
/// ```
/// use taceva_arrays::WrittenElement;
/// assert_eq!(WrittenElement::Text { bytes: 12 }.bytes(), 12);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum WrittenElement {
    /// Whole numbers without a sign, of 8 bits.
    U8,
    /// Whole numbers without a sign, of 16 bits.
    U16,
    /// Whole numbers with a sign, of 64 bits.
    I64,
    /// Numbers of single precision.
    F32,
    /// Numbers of double precision. A missing value is NaN.
    F64,
    /// UTF-8 texts of at most `bytes` bytes, padded with zeros.
    Text {
        /// Size of one text, bytes, at least 1.
        bytes: u32,
    },
}

impl WrittenElement {
    /// Bytes of one element.
    pub const fn bytes(self) -> u32 {
        match self {
            WrittenElement::U8 => 1,
            WrittenElement::U16 => 2,
            WrittenElement::F32 => 4,
            WrittenElement::I64 | WrittenElement::F64 => 8,
            WrittenElement::Text { bytes } => bytes,
        }
    }

    /// Datatype message of the type.
    pub(super) fn message(self) -> Vec<u8> {
        let size = self.bytes();
        let bits = u16::try_from(size.saturating_mul(8)).unwrap_or(u16::MAX);
        let mut message = Vec::new();
        let mut put = |class: u8, of_class: [u8; 3], rest: &[u8]| {
            // The version, 1, is in the bits above the class.
            message.push(0x10 | class);
            message.extend(of_class);
            message.extend(size.to_le_bytes());
            message.extend(rest);
        };
        let [low, high] = bits.to_le_bytes();
        let whole = [0, 0, low, high];
        // Bit offset and precision, position and width of exponent and mantissa, and the bias of the exponent.
        let single = [0, 0, low, high, 23, 8, 0, 23, 127, 0, 0, 0];
        let double = [0, 0, low, high, 52, 11, 0, 52, 0xff, 0x03, 0, 0];
        match self {
            WrittenElement::U8 | WrittenElement::U16 => put(0, [0, 0, 0], &whole),
            WrittenElement::I64 => put(0, [0x08, 0, 0], &whole),
            WrittenElement::F32 => put(1, [0x20, 31, 0], &single),
            WrittenElement::F64 => put(1, [0x20, 63, 0], &double),
            WrittenElement::Text { .. } => put(3, [0x11, 0, 0], &[]),
        }
        message
    }
}
