//! NumPy array file (`.npy`), versions 1 to 3 of the format.

use std::ops::Range;
use std::sync::Arc;

use crate::block::Block;
use crate::error::Problem;
use crate::fields::Item;
use crate::limits;
use crate::literal::Literal;
use crate::pickle::Pickle;
use crate::source::{ByteSource, bytes_of};
use crate::store::{Arrays, Store};
use crate::values::ArrayData;

const MAGIC: &[u8; 6] = b"\x93NUMPY";

/// NumPy array in any source of bytes.
#[derive(Debug)]
pub(crate) struct NpyArray {
    /// Name of the array in an archive; empty in an `.npy` file.
    name: String,
    content: Content,
}

#[derive(Debug)]
enum Content {
    Numbers(Block),
    /// Python values, stored as a pickle.
    Objects(Pickle),
}

/// Header of an array.
#[derive(Debug)]
pub(crate) struct NpyHeader {
    pub(crate) shape: Vec<u64>,
    descr: Literal,
    is_fortran: bool,
    /// Offset of the elements, bytes.
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
            _ => return Err(Problem::damaged(0, "not a NumPy array", "`\\x93NUMPY`")),
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
    /// Parses the header. Rejects an array that extends beyond the end of the source.
    pub(crate) fn open(name: &str, source: Arc<dyn ByteSource>) -> Result<NpyArray, Problem> {
        let header = NpyHeader::read(&*source)?;
        let name = name.to_owned();
        if header.descr == Literal::Text("|O".to_owned()) {
            let content = Content::Objects(Pickle::open(source, header.data_at)?);
            return Ok(NpyArray { name, content });
        }
        let item = Item::from_descr(&header.descr)?;
        let length = source.length();
        let block = Block::new(
            source,
            header.data_at,
            header.shape,
            item,
            header.is_fortran,
        )?;
        if block.end() != length {
            return Err(Problem::damaged(
                length,
                "the end",
                format!("the end at byte {}", block.end()),
            ));
        }
        let content = Content::Numbers(block);
        Ok(NpyArray { name, content })
    }

    /// Full name of the field `own` of this array.
    fn full(&self, own: &str) -> String {
        match (self.name.as_str(), own) {
            ("", own) => own.to_owned(),
            (name, "value") => name.to_owned(),
            (name, own) => format!("{name}.{own}"),
        }
    }
}

impl Store for NpyArray {
    fn arrays(&self) -> Arrays {
        match &self.content {
            Content::Numbers(block) => block.item().arrays(&self.full("value"), block.shape()),
            Content::Objects(pickle) => {
                let each = pickle.arrays().into_iter();
                each.map(|(own, info)| (self.full(&own), info)).collect()
            }
        }
    }

    fn refused(&self) -> &[(String, Problem)] {
        match &self.content {
            Content::Numbers(_) => &[],
            Content::Objects(pickle) => pickle.refused(),
        }
    }

    fn groups(&self) -> Vec<String> {
        match &self.content {
            Content::Numbers(_) => Vec::new(),
            Content::Objects(pickle) => pickle.groups(),
        }
    }

    fn read(&self, index: usize, rows: Range<u64>) -> Result<ArrayData, Problem> {
        match &self.content {
            Content::Numbers(block) => block.read(index, rows),
            Content::Objects(pickle) => pickle.read(index, rows),
        }
    }
}
