//! Interface of an open file in any format: a list of arrays, and access to the rows of each array.

use std::ops::Range;

use crate::element::ArrayInfo;
use crate::error::Problem;
use crate::values::ArrayData;

/// Arrays with their names, in the order of the file.
pub(crate) type Arrays = Vec<(String, ArrayInfo)>;

/// Open file of arrays.
pub(crate) trait Store: std::fmt::Debug + Send + Sync {
    /// Every array with its name.
    fn arrays(&self) -> Arrays;

    /// Unreadable arrays, each with the reason.
    fn refused(&self) -> &[(String, Problem)] {
        &[]
    }

    /// Links whose target cannot be read, each with the reason.
    fn nowhere(&self) -> &[(String, Problem)] {
        &[]
    }

    /// Error for a name that is a link to another place; `None` for other names.
    fn link(&self, _name: &str) -> Option<Problem> {
        None
    }

    /// Full names of the groups, unsorted; empty for formats without groups.
    fn groups(&self) -> Vec<String> {
        Vec::new()
    }

    /// Names of the attributes of the group or array `owner`.
    fn attributes(&self, _owner: &str) -> Vec<String> {
        Vec::new()
    }

    /// Attribute `name` of the group or array `owner`, as text; `None` if missing.
    fn attribute(&self, _owner: &str, _name: &str) -> Option<String> {
        None
    }

    /// Number of chunks of the array at `index` that the file does not contain. Their elements are read as the fill value.
    fn absent_chunks(&self, _index: usize) -> Result<u64, Problem> {
        Ok(0)
    }

    /// Reads `rows` of the first axis of the array at `index`. The caller has checked the rows against the shape and the limits.
    fn read(&self, index: usize, rows: Range<u64>) -> Result<ArrayData, Problem>;
}

/// Number of chunks of the lengths `chunk` in an array; [`u64::MAX`] on overflow.
pub(crate) fn chunks_of(shape: &[u64], chunk: &[u64]) -> u64 {
    let sides = shape.iter().zip(chunk);
    sides.fold(1, |all: u64, (side, chunk)| {
        all.saturating_mul(side.div_ceil((*chunk).max(1)))
    })
}
