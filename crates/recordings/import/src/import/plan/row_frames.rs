//! Finds the pictures of one row.

use std::path::Path;
use std::sync::Arc;

use super::reading::Reading;
use crate::error::ImportError;
use crate::import::frame_cells::FrameName;
use crate::import::frame_plan::{FrameSource, PlannedFrame};
use crate::import::rows::MappedTable;
use taceva_dataset::{Row, RowFrame};

impl Reading<'_> {
    /// Finds the frame of a row in the view at position `view`, and the frame without contact that the row names.
    pub(super) fn read_frame(
        &mut self,
        rows: &MappedTable<'_>,
        view: usize,
        row: usize,
        labels: &mut Row,
    ) -> Result<(), ImportError> {
        let (name, named_at) = rows.frame_name(view, row)?;
        let base = self.views[view].beside(rows.named_by.frame(view, row));
        let from = self
            .frame_source(rows, view, &base, name)
            .map_err(|error| error.named_at(named_at.clone()))?;
        let has_origin = self.map.origin.is_none() && labels.source_table.is_some();
        let origin = has_origin.then(|| from.origin(self.folder.path()));
        match self.views[view].map.view {
            None if has_origin => labels.source_frame = origin,
            None => {}
            Some(_) => {
                let mut frame = RowFrame::default();
                frame.source_frame = origin.or_else(|| rows.origin_of(view, row));
                labels.views.push(frame);
            }
        }
        self.views[view]
            .frames
            .push(PlannedFrame { from, named_at });
        if let Some((name, named_at)) = rows.reference_name(view, row) {
            let own = &mut self.views[view];
            let base = own.beside(rows.named_by.reference(view, row));
            own.references.take(self.folder, &base, name, named_at)?;
        }
        Ok(())
    }

    fn frame_source(
        &mut self,
        rows: &MappedTable<'_>,
        view: usize,
        base: &Path,
        name: FrameName,
    ) -> Result<FrameSource, ImportError> {
        let (pictures, index) = match (name, &rows.views[view].pictures) {
            (FrameName::File(name), _) => {
                let path = self.folder.file(base, &name)?;
                self.check_named_once(view, &path, rows)?;
                if !self.bases.contains(base) {
                    self.bases.insert(base.to_owned());
                }
                self.named.insert(path.clone());
                return Ok(FrameSource::File(path));
            }
            (FrameName::Within(Some(file), index), _) => {
                let pictures = self.pictures(view, &file)?;
                self.check_counted_once(view, &file, rows)?;
                self.note_unequal(view, &pictures, rows);
                (pictures, index)
            }
            (FrameName::Within(None, index), Some(pictures)) => {
                self.note_unequal(view, pictures, rows);
                (Arc::clone(pictures), index)
            }
            (FrameName::Within(None, index), None) => {
                return Err(ImportError::path(
                    &index.to_string(),
                    "a position without an array",
                ));
            }
        };
        pictures.check_index(index)?;
        Ok(FrameSource::Within(pictures, index))
    }
}
