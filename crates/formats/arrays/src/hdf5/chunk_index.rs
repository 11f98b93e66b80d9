//! Index of the chunks of a dataset, checked against the chunk grid and the extent.
//!
//! Without this check, `hdf5-pure` would skip a chunk with a damaged key and return the fill value for its elements.

use std::collections::BTreeSet;

use hdf5_pure::Dataset;

use super::problem;
use crate::error::Problem;
use crate::store::chunks_of;

/// Numbers of written and missing chunks, as counted in the index of a dataset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct ChunkIndex {
    /// Number of written chunks.
    pub(super) written: u64,
    /// Number of missing chunks within the extent.
    pub(super) absent: u64,
}

impl ChunkIndex {
    /// Reads the index of `dataset` with chunks of the lengths `chunk`; `None` if `hdf5-pure` does not support the kind of index.
    ///
    /// # Errors
    /// [`Problem::Damaged`] for a duplicate chunk, or a chunk off the grid or outside the extent. [`Problem::Structure`] for an invalid index.
    pub(super) fn read(
        dataset: &Dataset,
        shape: &[u64],
        chunk: &[u64],
    ) -> Result<Option<ChunkIndex>, Problem> {
        let chunks = match dataset.chunks().map_err(problem) {
            Ok(chunks) => chunks,
            Err(Problem::Unsupported { .. }) => return Ok(None),
            Err(problem) => return Err(problem),
        };
        let mut places = BTreeSet::new();
        for found in &chunks {
            let axes = found.offset.iter().zip(shape).zip(chunk);
            let is_on_grid = axes
                .into_iter()
                .all(|((at, side), length)| at < side && at % (*length).max(1) == 0);
            if !is_on_grid {
                return Err(wrong(
                    found.address,
                    &found.offset,
                    "is not on the grid of chunks or is outside the extent",
                ));
            }
            if !places.insert(found.offset.as_slice()) {
                return Err(wrong(found.address, &found.offset, "occurs twice"));
            }
        }
        let written = chunks.len() as u64;
        Ok(Some(ChunkIndex {
            written,
            absent: chunks_of(shape, chunk).saturating_sub(written),
        }))
    }
}

fn wrong(address: u64, offset: &[u64], what: &str) -> Problem {
    Problem::damaged(
        address,
        format!("a chunk whose key {offset:?} {what}"),
        "an intact index: the file is damaged, use another copy",
    )
}
