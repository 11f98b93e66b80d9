//! Folders of joined tables that name pictures. Paths are relative to the folder of the table that names them.

use std::path::{Path, PathBuf};

use super::Sources;
use crate::import::map::FrameNames;

/// Folders of the joined tables that name pictures, for each view.
#[derive(Debug, Default)]
pub(in crate::import) struct NamedBy {
    views: Vec<ViewNamedBy>,
}

/// For each row, the folder of the joined table that names the picture, and of the one that names the picture without contact. `None` if the main
/// table names them.
#[derive(Debug)]
struct ViewNamedBy {
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
        let views = sources.map.frames.iter();
        let views = views.map(|frame| ViewNamedBy {
            frames: match &frame.names {
                FrameNames::Column(column) => folders(column),
                _ => None,
            },
            references: frame.reference_column.as_deref().and_then(folders),
        });
        NamedBy {
            views: views.collect(),
        }
    }

    /// Folder of the joined table that names the picture of `row` in the view at position `view`; `None` if the main table names the picture.
    pub(in crate::import) fn frame(&self, view: usize, row: usize) -> Option<&Path> {
        Some(self.views.get(view)?.frames.as_ref()?.get(row)?)
    }

    /// Folder of the joined table that names the picture without contact of `row` in the view at position `view`; `None` if the main table names it.
    pub(in crate::import) fn reference(&self, view: usize, row: usize) -> Option<&Path> {
        Some(self.views.get(view)?.references.as_ref()?.get(row)?)
    }
}
