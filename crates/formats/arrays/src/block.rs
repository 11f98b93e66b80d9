//! Contiguous elements of an array, in C or Fortran order.

use std::ops::Range;
use std::sync::Arc;

use crate::error::Problem;
use crate::fields::Item;
use crate::limits;
use crate::order::ColumnMajor;
use crate::source::{ByteSource, bytes_of};
use crate::values::ArrayData;

/// Array with contiguous elements in a source.
#[derive(Debug)]
pub(crate) struct Block {
    source: Arc<dyn ByteSource>,
    at: u64,
    shape: Vec<u64>,
    item: Item,
    row_bytes: u64,
    columns: Option<ColumnMajor>,
}

impl Block {
    /// Describes elements that begin at byte `at` of `source`. Rejects elements beyond the end of the source.
    pub(crate) fn new(
        source: Arc<dyn ByteSource>,
        at: u64,
        shape: Vec<u64>,
        item: Item,
        is_fortran: bool,
    ) -> Result<Block, Problem> {
        let item_bytes = item.bytes as u64;
        let rest = shape.get(1..).unwrap_or(&[]);
        let row_bytes = rest
            .iter()
            .try_fold(item_bytes, |bytes, side| bytes.checked_mul(*side));
        let rows = shape.first().copied().unwrap_or(1);
        let end = row_bytes.and_then(|bytes| bytes.checked_mul(rows)?.checked_add(at));
        let (Some(row_bytes), Some(end)) = (row_bytes, end) else {
            return Err(Problem::too_large(
                "bytes of the shape",
                u64::MAX,
                source.length(),
            ));
        };
        if end > source.length() {
            return Err(Problem::damaged(
                source.length(),
                "the end",
                format!("the end at byte {end}, after {rows} rows of {row_bytes} bytes"),
            ));
        }
        if shape.len() > limits::AXES {
            return Err(Problem::too_large(
                "axes",
                shape.len() as u64,
                limits::AXES as u64,
            ));
        }
        let columns =
            (is_fortran && shape.len() > 1).then(|| ColumnMajor::new(&shape, item_bytes, at));
        Ok(Block {
            source,
            at,
            shape,
            item,
            row_bytes,
            columns,
        })
    }

    pub(crate) fn shape(&self) -> &[u64] {
        &self.shape
    }

    pub(crate) fn item(&self) -> &Item {
        &self.item
    }

    /// Offset of the end of the elements, bytes.
    pub(crate) fn end(&self) -> u64 {
        self.at + self.shape.first().copied().unwrap_or(1) * self.row_bytes
    }

    /// Bytes of `rows`, row by row.
    pub(crate) fn raw_rows(&self, rows: Range<u64>) -> Result<Vec<u8>, Problem> {
        let bytes = (rows.end - rows.start) * self.row_bytes;
        match &self.columns {
            Some(columns) => columns.rows(&*self.source, rows),
            None => bytes_of(&*self.source, self.at + rows.start * self.row_bytes, bytes),
        }
    }

    /// Reads the field with the index `field` in `rows`.
    pub(crate) fn read(&self, field: usize, rows: Range<u64>) -> Result<ArrayData, Problem> {
        let mut shape = self.shape.clone();
        if let Some(first) = shape.first_mut() {
            *first = rows.end - rows.start;
        }
        let field = &self.item.fields[field];
        if let (None, Some(scalar)) = (&self.columns, self.item.scalar()) {
            let count = (rows.end - rows.start) * (self.row_bytes / (scalar.bytes() as u64).max(1));
            let count = usize::try_from(count).unwrap_or(usize::MAX);
            let values =
                scalar.read(&*self.source, self.at + rows.start * self.row_bytes, count)?;
            return Ok(ArrayData { shape, values });
        }
        let raw = self.raw_rows(rows)?;
        self.item.read(field, raw, &shape)
    }
}
