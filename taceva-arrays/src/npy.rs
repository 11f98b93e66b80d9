//! `.npy`: one array of NumPy, versions 1 to 3 of the form.

use std::ops::Range;

use crate::error::Problem;
use crate::fields::Item;
use crate::limits;
use crate::literal::Literal;
use crate::order::ColumnMajor;
use crate::scalar::shown;
use crate::source::{ByteSource, bytes_of};
use crate::store::{Arrays, Store};
use crate::values::ArrayData;

const MAGIC: &[u8; 6] = b"\x93NUMPY";

/// An array of NumPy in any source of bytes.
#[derive(Debug)]
pub(crate) struct NpyArray {
    name: String,
    source: Box<dyn ByteSource>,
    shape: Vec<u64>,
    item: Item,
    row_bytes: u64,
    data_at: u64,
    columns: Option<ColumnMajor>,
}

/// What the header of an array says.
#[derive(Debug)]
pub(crate) struct NpyHeader {
    pub(crate) shape: Vec<u64>,
    descr: Literal,
    is_fortran: bool,
    /// Where the elements begin.
    pub(crate) data_at: u64,
}

impl NpyHeader {
    pub(crate) fn read(source: &dyn ByteSource) -> Result<NpyHeader, Problem> {
        let start = bytes_of(source, 0, source.length().min(12))?;
        let (at, length) = match start.as_slice() {
            [magic @ .., 1, _, low, high, _, _] if magic == MAGIC => {
                (10, u64::from(u16::from_le_bytes([*low, *high])))
            }
            [magic @ .., 2 | 3, _, a, b, c, d] if magic == MAGIC => {
                (12, u64::from(u32::from_le_bytes([*a, *b, *c, *d])))
            }
            [magic @ .., version, _, _, _, _, _] if magic == MAGIC => {
                return Err(Problem::damaged(
                    6,
                    format!("version {version}"),
                    "1, 2 or 3",
                ));
            }
            _ => return Err(Problem::damaged(0, "no array of NumPy", "`\\x93NUMPY`")),
        };
        if length > limits::NPY_HEADER_BYTES {
            return Err(Problem::too_large(
                "bytes of the header",
                length,
                limits::NPY_HEADER_BYTES,
            ));
        }
        let bytes = bytes_of(source, at, length)?;
        // Version 3 is UTF-8, the others Latin-1.
        let text = String::from_utf8(bytes)
            .unwrap_or_else(|error| error.into_bytes().into_iter().map(char::from).collect());
        let header = Literal::parse(text.trim_end_matches(['\0', '\n', ' ']), at)?;
        let missing = |key: &str, expected: &str| {
            Problem::damaged(at, format!("a header without `{key}`"), expected)
        };
        let shape = header
            .key("shape")
            .filter(|shape| matches!(shape, Literal::Sequence(_)));
        let shape = shape
            .and_then(Literal::shape)
            .ok_or_else(|| missing("shape", "a tuple of lengths"))?;
        let Some(Literal::Bool(is_fortran)) = header.key("fortran_order") else {
            return Err(missing("fortran_order", "True or False"));
        };
        let descr = header
            .key("descr")
            .ok_or_else(|| missing("descr", "a type"))?;
        Ok(NpyHeader {
            shape,
            descr: descr.clone(),
            is_fortran: *is_fortran,
            data_at: at + length,
        })
    }
}

impl NpyArray {
    /// Reads the header and compares it with the length of the source.
    pub(crate) fn open(name: &str, source: Box<dyn ByteSource>) -> Result<NpyArray, Problem> {
        let header = NpyHeader::read(&*source)?;
        let item = Item::from_descr(&header.descr)?;
        let item_bytes = item.bytes as u64;
        let rest = header.shape.get(1..).unwrap_or(&[]);
        let row_bytes = rest
            .iter()
            .try_fold(item_bytes, |bytes, side| bytes.checked_mul(*side));
        let rows = header.shape.first().copied().unwrap_or(1);
        let data = row_bytes.and_then(|bytes| bytes.checked_mul(rows));
        let expected = data.and_then(|data| data.checked_add(header.data_at));
        let (Some(row_bytes), Some(expected)) = (row_bytes, expected) else {
            return Err(Problem::too_large(
                "bytes of the shape",
                u64::MAX,
                source.length(),
            ));
        };
        if expected != source.length() {
            return Err(Problem::damaged(
                source.length(),
                "the end",
                format!("it at byte {expected}, after {rows} rows of {row_bytes} bytes"),
            ));
        }
        let columns = (header.is_fortran && header.shape.len() > 1)
            .then(|| ColumnMajor::new(&header.shape, item_bytes, header.data_at));
        Ok(NpyArray {
            name: name.to_owned(),
            source,
            shape: header.shape,
            item,
            row_bytes,
            data_at: header.data_at,
            columns,
        })
    }
}

impl Store for NpyArray {
    fn arrays(&self) -> Arrays {
        self.item.arrays(&self.name, &self.shape)
    }

    fn read(&self, index: usize, rows: Range<u64>) -> Result<ArrayData, Problem> {
        let count = rows.end - rows.start;
        let raw = match &self.columns {
            Some(columns) => columns.rows(&*self.source, rows)?,
            None => bytes_of(
                &*self.source,
                self.data_at + rows.start * self.row_bytes,
                count * self.row_bytes,
            )?,
        };
        let mut shape = self.shape.clone();
        if let Some(first) = shape.first_mut() {
            *first = count;
        }
        let field = self.item.fields.get(index);
        let field = field
            .ok_or_else(|| Problem::unsupported(format!("no field {index}"), shown(&self.name)))?;
        self.item.read(field, raw, &shape)
    }
}
