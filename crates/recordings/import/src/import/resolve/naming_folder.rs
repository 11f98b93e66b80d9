//! The folders of joined tables that name pictures: what a table names lies beside it.

use std::path::{Path, PathBuf};

use super::Sources;
use crate::import::map::FrameNames;

/// For each row the folder of the joined table that names its picture, and its picture without contact; none where the main table does.
#[derive(Debug, Default)]
pub(in crate::import) struct NamedBy {
    frames: Option<Vec<PathBuf>>,
    references: Option<Vec<PathBuf>>,
}

impl NamedBy {
    pub(super) fn of(sources: &Sources<'_>) -> NamedBy {
        let folders = |name: &str| -> Option<Vec<PathBuf>> {
            let (joined, _) = sources.joined_column(name)?;
            let rows = 0..sources.main.rows();
            Some(rows.map(|row| joined.folder(row).to_owned()).collect())
        };
        let Some(frame) = &sources.map.frame else {
            return NamedBy::default();
        };
        NamedBy {
            frames: match &frame.names {
                FrameNames::Column(column) => folders(column),
                _ => None,
            },
            references: frame.reference_column.as_deref().and_then(folders),
        }
    }

    /// The folder of the joined table that names the picture of `row`.
    pub(in crate::import) fn frame(&self, row: usize) -> Option<&Path> {
        Some(self.frames.as_ref()?.get(row)?)
    }

    /// That of its picture without contact.
    pub(in crate::import) fn reference(&self, row: usize) -> Option<&Path> {
        Some(self.references.as_ref()?.get(row)?)
    }
}
