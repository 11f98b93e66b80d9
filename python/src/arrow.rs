//! Export of a table as an Arrow stream of one batch, in a Python capsule.

mod structs;

use std::ffi::{CStr, CString};

use pyo3::prelude::*;
use pyo3::types::PyCapsule;

use crate::errors::value_error;
use structs::{Batch, Stream};

/// Cells of a column; missing values are `None`.
pub(crate) enum Cells {
    Texts(Vec<Option<String>>),
    Numbers(Vec<Option<f64>>),
    Counts(Vec<Option<u32>>),
}

impl Cells {
    /// True if no row has a value.
    pub(crate) fn are_absent(&self) -> bool {
        !self.is_there().contains(&true)
    }

    fn is_there(&self) -> Vec<bool> {
        match self {
            Cells::Texts(cells) => cells.iter().map(Option::is_some).collect(),
            Cells::Numbers(cells) => cells.iter().map(Option::is_some).collect(),
            Cells::Counts(cells) => cells.iter().map(Option::is_some).collect(),
        }
    }
}

/// A column of a table.
pub(crate) struct ArrowColumn {
    name: CString,
    /// Encoded metadata of the field, such as its unit.
    metadata: Vec<u8>,
    cells: Cells,
}

impl ArrowColumn {
    /// Creates the column `name` with the metadata of its field.
    pub(crate) fn new(
        name: &str,
        cells: Cells,
        metadata: &[(&str, &str)],
    ) -> PyResult<ArrowColumn> {
        Ok(ArrowColumn {
            name: CString::new(name).map_err(|_| {
                value_error(format_args!("column {name:?}: expected a name without NUL"))
            })?,
            metadata: encoded(metadata)?,
            cells,
        })
    }

    /// Format string of the column's type in the Arrow C interface.
    const fn format(&self) -> &'static CStr {
        match self.cells {
            // 64-bit offsets, so that a column has no size limit.
            Cells::Texts(_) => c"U",
            Cells::Numbers(_) => c"g",
            Cells::Counts(_) => c"I",
        }
    }

    /// Arrow buffers of the column after the validity bitmap: the values; for texts, the offsets and then the values.
    fn values(&self) -> Vec<Vec<u64>> {
        match &self.cells {
            Cells::Texts(cells) => {
                let mut offsets = vec![0];
                let mut letters = Vec::new();
                for cell in cells {
                    letters.extend_from_slice(cell.as_deref().unwrap_or_default().as_bytes());
                    offsets.push(letters.len() as u64);
                }
                vec![offsets, aligned(letters)]
            }
            Cells::Numbers(cells) => {
                let bits = cells.iter().map(|cell| cell.unwrap_or(0.0).to_bits());
                vec![bits.collect()]
            }
            Cells::Counts(cells) => {
                let bytes = cells
                    .iter()
                    .flat_map(|cell| cell.unwrap_or(0).to_ne_bytes());
                vec![aligned(bytes.collect())]
            }
        }
    }
}

/// Bytes in 8-byte alignment, padded with zeros.
fn aligned(bytes: Vec<u8>) -> Vec<u64> {
    let word = |bytes: &[u8]| {
        let mut word = [0; 8];
        word[..bytes.len()].copy_from_slice(bytes);
        u64::from_ne_bytes(word)
    };
    bytes.chunks(8).map(word).collect()
}

/// Metadata in the encoding of the Arrow C interface: 32-bit counts and lengths, then the bytes.
fn encoded(pairs: &[(&str, &str)]) -> PyResult<Vec<u8>> {
    let size = |length: usize| {
        i32::try_from(length)
            .map(i32::to_ne_bytes)
            .map_err(value_error)
    };
    let mut bytes = size(pairs.len())?.to_vec();
    for text in pairs.iter().flat_map(|(name, value)| [name, value]) {
        bytes.extend(size(text.len())?);
        bytes.extend_from_slice(text.as_bytes());
    }
    Ok(bytes)
}

/// Capsule for `__arrow_c_stream__` with `columns` of `rows` rows and metadata of the table.
pub(crate) fn stream<'py>(
    py: Python<'py>,
    rows: usize,
    columns: Vec<ArrowColumn>,
    metadata: &[(&str, &str)],
) -> PyResult<Bound<'py, PyCapsule>> {
    let batch = Batch {
        rows,
        columns,
        metadata: encoded(metadata)?,
    };
    PyCapsule::new_with_value(py, Stream::of(batch), c"arrow_array_stream")
}
