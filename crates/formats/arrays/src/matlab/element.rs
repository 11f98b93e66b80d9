//! Elements of a MATLAB file of version 5: a tag with type and length, then the bytes, padded to a multiple of 8.

use crate::error::Problem;
use crate::scalar::{Kind, Scalar};
use crate::source::{ByteSource, bytes_of};

pub(crate) const TYPE_UTF_8: u32 = 16;
pub(crate) const TYPE_UTF_16: u32 = 17;
pub(crate) const TYPE_MATRIX: u32 = 14;
pub(crate) const TYPE_COMPRESSED: u32 = 15;

/// Offset of an element in a MATLAB file, and the byte order of the file.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Place {
    pub(crate) at: u64,
    pub(crate) is_big_endian: bool,
}

/// Tag of an element.
#[derive(Clone, Debug)]
pub(crate) struct Tag {
    pub(crate) kind: u32,
    pub(crate) data_at: u64,
    /// Offset after the last byte of content, before the padding.
    pub(crate) end: u64,
    /// Offset of the next element.
    pub(crate) next: u64,
}

/// Type and length in a tag.
pub(crate) fn words(bytes: [u8; 8], is_big_endian: bool) -> (u32, u32) {
    let [a, b, c, d, e, f, g, h] = bytes;
    let word = if is_big_endian {
        u32::from_be_bytes
    } else {
        u32::from_le_bytes
    };
    (word([a, b, c, d]), word([e, f, g, h]))
}

/// Reads the tag at `place`. Rejects an element that extends beyond the end of the source.
pub(crate) fn tag(source: &dyn ByteSource, place: Place) -> Result<Tag, Problem> {
    let bytes = bytes_of(source, place.at, 8)?;
    let first = bytes.first_chunk::<8>().copied().unwrap_or_default();
    let (kind, length) = words(first, place.is_big_endian);
    // Up to 4 bytes are in the tag itself, with their length above the type.
    let (kind, data_at, length, next) = if kind >> 16 != 0 {
        (
            kind & 0xffff,
            place.at + 4,
            u64::from(kind >> 16),
            place.at + 8,
        )
    } else {
        let length = u64::from(length);
        (
            kind,
            place.at + 8,
            length,
            (place.at + 8 + length).next_multiple_of(8),
        )
    };
    let end = data_at + length;
    if end > source.length() || (next == place.at + 8 && length > 4 && data_at == place.at + 4) {
        return Err(Problem::damaged(
            place.at,
            format!("an element of {length} bytes"),
            format!("an element that ends by byte {}", source.length()),
        ));
    }
    Ok(Tag {
        kind,
        data_at,
        end,
        next,
    })
}

/// Content bytes of the element with this tag.
pub(crate) fn content(source: &dyn ByteSource, tag: &Tag) -> Result<Vec<u8>, Problem> {
    bytes_of(source, tag.data_at, tag.end - tag.data_at)
}

/// Numeric element type of the MATLAB type code `kind`; `None` for other codes.
pub(crate) fn scalar(kind: u32, is_big_endian: bool) -> Option<Scalar> {
    let (kind, bytes) = match kind {
        1 => (Kind::Signed, 1),
        2 => (Kind::Unsigned, 1),
        3 => (Kind::Signed, 2),
        4 | TYPE_UTF_16 => (Kind::Unsigned, 2),
        5 => (Kind::Signed, 4),
        6 => (Kind::Unsigned, 4),
        7 => (Kind::Float, 4),
        9 => (Kind::Float, 8),
        12 => (Kind::Signed, 8),
        13 => (Kind::Unsigned, 8),
        _ => return None,
    };
    Scalar::new(kind, bytes, is_big_endian)
}
