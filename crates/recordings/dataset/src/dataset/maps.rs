//! Depth maps of a dataset, read and verified on request.

use super::Dataset;
use super::verify::check_digest;
use crate::digest::Digest;
use crate::error::DatasetError;
use crate::layout;
use crate::maps::StoredMap;
use crate::pack::read_span;
use crate::task::{MapEntry, TaskLabel};

impl Dataset {
    /// Depth map of a row for the task called `task`, in mm; `None` if the row has none.
    ///
    /// # Errors
    /// [`DatasetError::Request`] for an unknown task or row, and for a task of another kind; [`DatasetError::Digest`] if the map differs from the
    /// recorded digest; [`DatasetError::Damaged`] if its bytes are not a map; [`DatasetError::Io`].
    pub fn depth_map(&self, task: &str, row: usize) -> Result<Option<StoredMap>, DatasetError> {
        let Some(bytes) = self.depth_map_bytes(task, row)? else {
            return Ok(None);
        };
        let own = self.task_called(task)?.task();
        let damaged = |problem: String| {
            let pack = self.path().join(layout::map_pack_path(task));
            DatasetError::damaged(&pack, format!("the map of row {row}: {problem}"))
        };
        let facts = own.maps.as_ref();
        let facts = facts.ok_or_else(|| damaged("the header states no unit".to_owned()))?;
        StoredMap::of(&bytes, facts).map(Some).map_err(damaged)
    }

    /// Stored bytes of the depth map of a row, verified; `None` if the row has none.
    ///
    /// # Errors
    /// Errors of [`depth_map`](Dataset::depth_map), but the bytes are not decoded.
    #[doc(hidden)]
    pub fn depth_map_bytes(&self, task: &str, row: usize) -> Result<Option<Vec<u8>>, DatasetError> {
        self.check_row(row)?;
        match self.task_called(task)?.label(row) {
            Some(TaskLabel::Map(entry)) => match self.recording_of(row) {
                Some((recording, row)) => recording.depth_map_bytes(task, row),
                None => self.map_bytes(task, entry).map(Some),
            },
            Some(_) => Err(DatasetError::request(
                self.path(),
                format!("the task `{task}` has no depth maps"),
            )),
            None => Ok(None),
        }
    }

    fn map_bytes(&self, task: &str, entry: MapEntry) -> Result<Vec<u8>, DatasetError> {
        let relative = layout::map_pack_path(task);
        let path = self.path().join(&relative);
        let (file, _) = self.folder.file(&relative, u64::MAX)?;
        let bytes = read_span(file, &path, entry.span)?;
        check_digest(&path, entry.digest, Digest::of(&bytes))?;
        Ok(bytes)
    }

    /// Reads all depth maps and checks their digests.
    pub(super) fn verify_maps(&self) -> Result<(), DatasetError> {
        for own in self.tasks() {
            for row in 0..self.table.rows() {
                if let Some(TaskLabel::Map(entry)) = own.label(row) {
                    self.map_bytes(&own.task().name, entry)?;
                }
            }
        }
        Ok(())
    }
}
