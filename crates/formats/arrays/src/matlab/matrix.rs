//! Header of a matrix in a MATLAB file: class, flags, lengths of axes and name.

use super::element::{Place, TYPE_MATRIX, content, tag, words};
use crate::error::Problem;
use crate::limits;
use crate::scalar::shown;
use crate::source::ByteSource;

/// Header of a matrix.
#[derive(Debug)]
pub(crate) struct Matrix {
    pub(crate) class: u32,
    pub(crate) flags: u32,
    pub(crate) shape: Vec<u64>,
    pub(crate) name: String,
    /// Location of the content after the header. `end` is the offset of its end, bytes.
    pub(crate) content: Place,
    pub(crate) end: u64,
    pub(crate) next: u64,
}

/// Parses the flags, lengths and name of the matrix at `place`.
pub(crate) fn matrix(source: &dyn ByteSource, place: Place) -> Result<Matrix, Problem> {
    let big = place.is_big_endian;
    let whole = tag(source, place)?;
    if whole.kind != TYPE_MATRIX {
        return Err(Problem::damaged(
            place.at,
            format!("an element of type {}", whole.kind),
            "a matrix, type 14",
        ));
    }
    if whole.data_at == whole.end {
        // An empty cell.
        return Ok(Matrix {
            class: 6,
            flags: 0,
            shape: vec![0, 0],
            name: String::new(),
            content: Place {
                at: whole.end,
                is_big_endian: big,
            },
            end: whole.end,
            next: whole.next,
        });
    }
    let flags = tag(
        source,
        Place {
            at: whole.data_at,
            is_big_endian: big,
        },
    )?;
    let first = content(source, &flags)?
        .first_chunk::<8>()
        .map(|bytes| words(*bytes, big).0);
    let first =
        first.ok_or_else(|| Problem::damaged(flags.data_at, "no matrix flags", "8 bytes"))?;
    let lengths = tag(
        source,
        Place {
            at: flags.next,
            is_big_endian: big,
        },
    )?;
    let axes = (lengths.end - lengths.data_at) / 4;
    if axes > limits::AXES as u64 {
        return Err(Problem::too_large("axes", axes, limits::AXES as u64));
    }
    let sides = content(source, &lengths)?;
    let shape = sides
        .as_chunks::<4>()
        .0
        .iter()
        .map(|side| number(side, big))
        .collect::<Option<Vec<u64>>>();
    let shape = shape
        .ok_or_else(|| Problem::damaged(lengths.data_at, "a negative length", "lengths of axes"))?;
    let name = tag(
        source,
        Place {
            at: lengths.next,
            is_big_endian: big,
        },
    )?;
    if name.end - name.data_at > limits::NPY_HEADER_BYTES
        || name.next > whole.end.next_multiple_of(8)
    {
        return Err(Problem::damaged(
            name.data_at,
            "a name that exceeds its matrix",
            "a name within its matrix",
        ));
    }
    Ok(Matrix {
        class: first & 0xff,
        flags: first,
        shape,
        name: text_of(&content(source, &name)?),
        content: Place {
            at: name.next,
            is_big_endian: big,
        },
        end: whole.end,
        next: whole.next,
    })
}

/// Product of the axis lengths `sides`; `None` if it exceeds 64 bits.
pub(crate) fn product(sides: &[u64]) -> Option<u64> {
    sides
        .iter()
        .try_fold(1_u64, |product, side| product.checked_mul(*side))
}

/// First 4 bytes as a signed number; `None` if it is negative or bytes are missing.
pub(crate) fn number(bytes: &[u8], is_big_endian: bool) -> Option<u64> {
    let bytes = *bytes.first_chunk::<4>()?;
    let number = if is_big_endian {
        i32::from_be_bytes(bytes)
    } else {
        i32::from_le_bytes(bytes)
    };
    u64::try_from(number).ok()
}

/// Text before the first zero byte, escaped for messages.
pub(crate) fn text_of(bytes: &[u8]) -> String {
    let end = bytes
        .iter()
        .position(|byte| *byte == 0)
        .unwrap_or(bytes.len());
    shown(&String::from_utf8_lossy(&bytes[..end]))
}
