//! Pictures of a table: the cells that name them, for each view.

use std::path::{Component, Path};
use std::sync::Arc;

use super::MappedTable;
use crate::error::{ImportError, Place};
use crate::foreign::{DepthPixels, ForeignTable, Pictures, TableForm};
use crate::import::frame_cells::{FrameCells, FrameName, filled};
use crate::import::map::{FrameMap, FrameNames, ImportMap};
use crate::import::resolve::ResolvedTable;
use taceva_dataset::internal::shown;

/// Pictures of one view, as the rows of a table name them.
pub(in crate::import) struct MappedView {
    cells: FrameCells,
    /// Column that names the frame without contact of each row.
    reference: Option<usize>,
    /// Column with the path of the original picture.
    pub(super) origin: Option<usize>,
    /// Pictures inside the file of the table; `None` for separate files.
    pub(in crate::import) pictures: Option<Arc<dyn Pictures>>,
    /// Conversion of the codes of a depth map in the clips to pixels; `None` for pictures.
    pub(in crate::import) depth: Option<DepthPixels>,
}

impl MappedView {
    pub(super) fn find(
        map: &ImportMap,
        frame: &FrameMap,
        main: &ForeignTable,
        table: &ResolvedTable,
        path: &Path,
    ) -> Result<MappedView, ImportError> {
        let names = &frame.names;
        let cells = match (&map.form, names) {
            (TableForm::LeRobot, FrameNames::Video(video)) => {
                FrameCells::Clips(main.clips(&video.file)?)
            }
            _ => FrameCells::find(names, table)?,
        };
        let depth = match names {
            FrameNames::Video(video) => {
                let depth = match (main.depth(&video.file), video.range) {
                    (Some(codes), range) => DepthPixels::new(codes, range).map(Some),
                    (None, None) => Ok(None),
                    (None, Some(_)) => Err(format!(
                        "`range` and `bits` need an `array` or a depth map of LeRobot, and `{}` is neither",
                        shown(&video.file)
                    )),
                };
                depth.map_err(|problem| ImportError::table(path, problem))?
            }
            _ => None,
        };
        let inside = names.is_in_table().then_some(names);
        let reference = frame.reference_column.as_ref();
        let origin = map.origin.as_ref();
        let origin = origin.and_then(|origin| origin.frames.get(frame.view.as_ref()?));
        Ok(MappedView {
            cells,
            reference: reference.map(|name| table.position(name)).transpose()?,
            origin: origin.map(|name| table.position(name)).transpose()?,
            pictures: inside.map(|names| main.pictures(names)).transpose()?,
            depth,
        })
    }
}

impl MappedTable<'_> {
    /// Name of the frame of a row in the view at position `view`, with its place.
    pub(in crate::import) fn frame_name(
        &self,
        view: usize,
        row: usize,
    ) -> Result<(FrameName, Place), ImportError> {
        let (name, column) = match &self.views[view].cells {
            FrameCells::Column(column) => (
                FrameName::File(self.table.cell(row, *column).to_owned()),
                *column,
            ),
            FrameCells::Pattern(parts) => {
                let cell = |column| self.table.cell(row, column);
                (FrameName::File(filled(parts, cell)), usize::MAX)
            }
            FrameCells::Within { file, index } => {
                let at = self.count(row, Some(*index))?.ok_or_else(|| {
                    self.wrong(row, *index, "empty, expected the position of a frame")
                })?;
                let cell = |column| self.table.cell(row, column);
                let file = file.as_ref().map(|parts| filled(parts, cell));
                (FrameName::Within(file, u64::from(at)), *index)
            }
            FrameCells::Clips(clips) => {
                let (file, frame) = &clips[row];
                let file = match self.table.source() {
                    "" | "." => file.clone(),
                    folder => format!("{folder}/{file}"),
                };
                (FrameName::Within(Some(file), *frame), usize::MAX)
            }
            FrameCells::OfRow => (FrameName::Within(None, row as u64), usize::MAX),
        };
        Ok((name, self.table.place(row, column)))
    }

    /// Name of the frame without contact of a row, with its place; `None` if the map names no column of such frames.
    pub(in crate::import) fn reference_name(
        &self,
        view: usize,
        row: usize,
    ) -> Option<(&str, Place)> {
        let column = self.views[view].reference?;
        Some((self.table.cell(row, column), self.table.place(row, column)))
    }

    /// Original picture of a row in a view; `None` unless the map is from an export.
    pub(in crate::import) fn origin_of(&self, view: usize, row: usize) -> Option<String> {
        let cell = self.table.cell(row, self.views[view].origin?);
        (!cell.is_empty()).then(|| cell.to_owned())
    }

    /// Rules of `[drop]` that exclude the row because of a picture in a clip or an array, such as `clip.mp4#12`.
    pub(super) fn names_within_left_out(&self, row: usize) -> Vec<String> {
        let rules = &self.map.drop.frames_named;
        if !rules.iter().any(|rule| rule.contains('#')) {
            return Vec::new();
        }
        let names = (0..self.views.len()).filter_map(|view| match self.frame_name(view, row) {
            Ok((FrameName::Within(file, index), _)) => {
                let file = file.as_deref().unwrap_or(self.table.source());
                Some(format!("{file}#{index}"))
            }
            _ => None,
        });
        let names = names.filter(|name| rules.contains(name));
        names
            .map(|name| format!("frame `{}`", shown(&name)))
            .collect()
    }

    /// Rules of `[drop]` that exclude the row because of the names of its pictures.
    pub(super) fn names_left_out(&self, row: usize) -> Vec<String> {
        let rules = &self.map.drop.frames_named;
        let views = self.map.frames.iter().zip(&self.views);
        let reasons = views.filter_map(|(frame, view)| {
            let cell = |column| self.table.cell(row, column);
            let name = match &view.cells {
                FrameCells::Column(column) => cell(*column).to_owned(),
                // An empty cell names no picture.
                FrameCells::Pattern(parts) if parts.iter().any(|part| part.is_empty(cell)) => {
                    String::new()
                }
                FrameCells::Pattern(parts) => filled(parts, cell),
                _ => return None,
            };
            let of_view = frame.view.iter();
            let of_view: String = of_view.map(|view| format!(" of view {view}")).collect();
            let inside = self.base_of(frame).join(&name);
            let is_named = rules
                .iter()
                .any(|known| *known == name || is_same(Path::new(known), &inside));
            is_named.then(|| format!("frame `{}`{of_view}", shown(&name)))
        });
        reasons.collect()
    }

    /// Folder of the pictures of `frame`, if the main table names them, relative to the lab's folder.
    fn base_of<'f>(&'f self, frame: &'f FrameMap) -> &'f Path {
        match (&frame.folder, &self.map.form) {
            (Some(folder), _) => Path::new(folder),
            (None, TableForm::Files) => Path::new(""),
            (None, _) => {
                let table = Path::new(self.table.source());
                table.parent().unwrap_or(table)
            }
        }
    }
}

/// True if two relative paths refer to the same file.
fn is_same(one: &Path, other: &Path) -> bool {
    let is_name = |part: &Component<'_>| *part != Component::CurDir;
    let one = one.components().filter(is_name);
    one.eq(other.components().filter(is_name))
}
