//! What every form gives: a list of arrays, and rows of each.

use std::ops::Range;

use crate::element::ArrayInfo;
use crate::error::Problem;
use crate::values::ArrayData;

/// Arrays with their names, in the order of the file.
pub(crate) type Arrays = Vec<(String, ArrayInfo)>;

/// A file of arrays that is open.
pub(crate) trait Store: std::fmt::Debug + Send + Sync {
    /// Every array with its name.
    fn arrays(&self) -> Arrays;

    /// Arrays that are there and cannot be read, with the reason.
    fn refused(&self) -> &[(String, Problem)] {
        &[]
    }

    /// Links that lead nowhere, with the reason: what lies behind them has no array and no group.
    fn nowhere(&self) -> &[(String, Problem)] {
        &[]
    }

    /// Why an array that is not among them has a name here: it is a link to elsewhere.
    fn link(&self, _name: &str) -> Option<Problem> {
        None
    }

    /// The full names of the groups, in no order; forms without groups have none.
    fn groups(&self) -> Vec<String> {
        Vec::new()
    }

    /// The names of the attributes of the group or array `owner`.
    fn attributes(&self, _owner: &str) -> Vec<String> {
        Vec::new()
    }

    /// The attribute `name` of the group or array `owner`, as text.
    fn attribute(&self, _owner: &str, _name: &str) -> Option<String> {
        None
    }

    /// How many chunks of the array at `index` of the list were never written, so that their elements are the fill value.
    fn absent_chunks(&self, _index: usize) -> Result<u64, Problem> {
        Ok(0)
    }

    /// Rows of the array at `index` of the list; they were checked against its shape and the limits.
    fn read(&self, index: usize, rows: Range<u64>) -> Result<ArrayData, Problem>;
}

/// How many chunks an array has, as far as 64 bits can say.
pub(crate) fn chunks_of(shape: &[u64], chunk: &[u64]) -> u64 {
    let sides = shape.iter().zip(chunk);
    sides.fold(1, |all: u64, (side, chunk)| {
        all.saturating_mul(side.div_ceil((*chunk).max(1)))
    })
}
