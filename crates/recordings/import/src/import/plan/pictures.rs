//! Opens the files that contain the pictures of rows, and checks the numbers of pictures.

use std::path::Path;
use std::sync::Arc;

use super::name_order::counted_otherwise;
use super::reading::Reading;
use crate::error::{ImportError, Place};
use crate::foreign::{ArrayPictures, ClipPictures, Pictures, SeveralPictures, TableForm};
use crate::import::map::{FrameNames, OWN_ROW};
use crate::import::pattern_column::PatternColumn;
use crate::import::rows::MappedTable;
use crate::import::source::matching_files;
use taceva_dataset::internal::shown;

impl Reading<'_> {
    /// Checks that no two tables use the pictures in `file` by row number alone. Each table would otherwise begin with the first picture again.
    pub(super) fn check_counted_once(
        &mut self,
        view: usize,
        file: &str,
        rows: &MappedTable<'_>,
    ) -> Result<(), ImportError> {
        let own = &mut self.views[view];
        let (key, index) = match &own.map.names {
            FrameNames::Array(array) => ("array", &array.index),
            FrameNames::Video(video) => ("video", &video.index),
            _ => return Ok(()),
        };
        let is_own_row = index == OWN_ROW || index == "row" && !rows.has_row_column;
        if !is_own_row {
            return Ok(());
        }
        let first = match own.counted.get(file) {
            Some(first) if *first == self.current => return Ok(()),
            Some(first) => first,
            None => {
                own.counted.insert(file.to_owned(), self.current.clone());
                return Ok(());
            }
        };
        let each = match self.map.form {
            TableForm::Files => format!("{} files, each of them a row,", self.count),
            _ => format!("{} tables", self.count),
        };
        Err(ImportError::path(
            file,
            format!(
                "the pictures of `{key}` already belong to the rows of {}, and each of the {each} would start again at the first picture: \
                 set `index = \"COLUMN\"` to a column that numbers the pictures of all tables, or put `{{path.NAME}}` in `{key}` to name a file for each",
                shown(&self.folder.inside(first, ""))
            ),
        ))
    }

    /// Stores an error if the numbers of pictures and rows differ and the map states no `index`. An error in a table is more specific, so this error
    /// is returned after all tables are read.
    pub(super) fn note_unequal(
        &mut self,
        view: usize,
        pictures: &Arc<dyn Pictures>,
        rows: &MappedTable<'_>,
    ) {
        let index = match &self.views[view].map.names {
            FrameNames::Array(array) => &array.index,
            FrameNames::Video(video) => &video.index,
            _ => return,
        };
        let (count, rows) = (pictures.count(), rows.rows() as u64);
        // A LeRobot table states the clip and frame of each row itself.
        if index != OWN_ROW
            || self.map.form == TableForm::LeRobot
            || count == rows
            || self.unequal.is_some()
        {
            return;
        }
        let axes = match &self.views[view].map.names {
            FrameNames::Array(_) => "; the order of the axes may be wrong, too (`layout`)",
            _ => "",
        };
        let first = match count > rows {
            true => format!(", or write `index = \"row\"` if the first {rows} match in order"),
            false => String::new(),
        };
        let problem = format!(
            "{count} pictures for {rows} rows, and no `index`: name the column with the number of the picture{first}{axes}"
        );
        let unequal = ImportError::image(pictures.path(), problem);
        self.unequal = Some(unequal.named_at(Place::file(&self.current)));
    }

    /// Checks that no two tables name the picture at `path` by the number of a row in each table.
    pub(super) fn check_named_once(
        &mut self,
        view: usize,
        path: &Path,
        rows: &MappedTable<'_>,
    ) -> Result<(), ImportError> {
        let own = &mut self.views[view];
        let is_by_row = match &own.map.names {
            FrameNames::Pattern(pattern) => {
                PatternColumn::all(pattern, |_| false).any(|column| column.name == "row")
            }
            _ => false,
        };
        if !is_by_row || rows.has_row_column || self.count < 2 {
            return Ok(());
        }
        let inside = self.folder.inside(path, "");
        match own.counted.get(&inside) {
            Some(first) if *first != self.current => Err(ImportError::path(
                &inside,
                format!(
                    "already the picture of a row of {}: `row` in `pattern` starts anew in each of the {} tables. Replace `row` by a column that numbers the pictures of all tables, or put `{{path.NAME}}` before it",
                    shown(&self.folder.inside(first, "")),
                    self.count
                ),
            )),
            Some(_) => Ok(()),
            None => {
                own.counted.insert(inside, self.current.clone());
                Ok(())
            }
        }
    }

    /// Pictures in the file at `relative`, which is opened once. With `*`, the pictures of all matching files, numbered consecutively.
    pub(super) fn pictures(
        &mut self,
        view: usize,
        relative: &str,
    ) -> Result<Arc<dyn Pictures>, ImportError> {
        let path = self.folder.path().join(relative);
        if let Some(known) = self.views[view].opened.get(&path) {
            return Ok(Arc::clone(known));
        }
        let found = matching_files(self.folder, relative)?;
        if let Some([first, second]) = counted_otherwise(&found) {
            return Err(ImportError::path(
                relative,
                format!(
                    "numbers pictures through these files in the order of their names, and {} sorts before {}, so the order is ambiguous: give their numbers the same count of digits, or name a file for each table by `{{path.NAME}}`",
                    shown(&self.folder.inside(first, "")),
                    shown(&self.folder.inside(second, ""))
                ),
            ));
        }
        let found = found.into_iter();
        let files = found.map(|file| self.open(view, &file, relative));
        let mut files = files.collect::<Result<Vec<_>, _>>()?;
        let pictures = match files.len() {
            1 => files.remove(0),
            _ => Arc::new(SeveralPictures::new(files)),
        };
        self.views[view].opened.insert(path, Arc::clone(&pictures));
        Ok(pictures)
    }

    fn open(
        &self,
        view: usize,
        path: &Path,
        relative: &str,
    ) -> Result<Arc<dyn Pictures>, ImportError> {
        let own = &self.views[view];
        Ok(match &own.map.names {
            names @ FrameNames::Array(array) => Arc::new(ArrayPictures::open(path, names, array)?),
            FrameNames::Video(_) => {
                let depth = own.depth.clone();
                Arc::new(ClipPictures::open(path, self.decoders, depth)?)
            }
            _ => {
                return Err(ImportError::path(relative, "neither an array nor a clip"));
            }
        })
    }
}
