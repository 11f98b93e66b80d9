//! Tables of other programs: rows of cells, accessed by column name.

mod arrays;
mod byte_pictures;
pub(crate) mod cell_list;
mod clip_rows;
mod clips;
mod columns;
mod delimited;
mod depth_pixels;
mod file_series;
mod files;
mod json;
mod lerobot;
mod members;
mod messages;
mod nested_tables;
mod one_array;
mod pictures;
mod table_form;
pub(crate) mod tar;
mod webdataset;

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;
use std::sync::Arc;

use crate::error::{ImportError, Place, table_error};
use crate::frame_names::FrameNames;
use crate::source_folder::SourceFolder;
use taceva_core::nearest;
use taceva_dataset::internal::{listed, shown};
use taceva_tables::{ArrowTable, DepthCodes, ParquetTable};
use taceva_video::Decoders;

pub(crate) use arrays::{ArrayPictures, stated};
pub(crate) use clips::ClipPictures;
pub(crate) use columns::{BeforeCut, ColumnTable, PictureColumn, PictureKind, Stated};
pub(crate) use delimited::DelimitedTable;
pub(crate) use depth_pixels::DepthPixels;
pub(crate) use file_series::SeveralPictures;
pub(crate) use files::FileRows;
pub(crate) use json::JsonRows;
pub(crate) use messages::{Topics, is_recording};
pub(crate) use one_array::OneArray;
pub(crate) use pictures::{Picture, Pictures};
pub(crate) use table_form::TableForm;

/// Table in any supported form.
#[derive(Debug)]
pub(crate) enum ForeignTable {
    Delimited(DelimitedTable),
    Json(JsonRows),
    Files(FileRows),
    Columns(ColumnTable),
}

/// Error message about the file at `path`, without the path, because the outer error names it.
pub(crate) fn said(path: &Path, error: &impl fmt::Display) -> String {
    let text = error.to_string();
    let rest = text.strip_prefix(&format!("{}: ", path.display()));
    rest.unwrap_or(&text).to_owned()
}

impl ForeignTable {
    /// Reads the table at `path`.
    pub(crate) fn read(path: &Path, form: &TableForm) -> Result<ForeignTable, ImportError> {
        ForeignTable::read_by(path, form, &Decoders::default())
    }

    /// Reads the table at `path`. `decoders` are programs that read the times of a clip.
    pub(crate) fn read_by(
        path: &Path,
        form: &TableForm,
        decoders: &Decoders,
    ) -> Result<ForeignTable, ImportError> {
        Ok(match form {
            TableForm::Delimited(form) => {
                ForeignTable::Delimited(DelimitedTable::read(path, form)?)
            }
            TableForm::Json { rows } => ForeignTable::Json(JsonRows::read(path, rows.as_deref())?),
            TableForm::JsonLines => ForeignTable::Json(JsonRows::read_lines(path)?),
            TableForm::Files => ForeignTable::Files(FileRows::one(path)),
            TableForm::Parquet => ForeignTable::Columns(ColumnTable::open(path, || {
                nested_tables::NestedRows::<ParquetTable>::open(path)
            })?),
            TableForm::Arrow => ForeignTable::Columns(ColumnTable::open(path, || {
                nested_tables::NestedRows::<ArrowTable>::open(path)
            })?),
            TableForm::LeRobot => ForeignTable::Columns(ColumnTable::open(path, || {
                lerobot::LeRobotRows::open(path)
            })?),
            TableForm::Clip { rate, start_s } => {
                ForeignTable::Columns(ColumnTable::open(path, || {
                    clip_rows::ClipRows::open(path, *rate, *start_s, decoders)
                })?)
            }
            TableForm::WebDataset => {
                ForeignTable::Columns(ColumnTable::open(path, || webdataset::Shard::open(path))?)
            }
            TableForm::Messages { topic, is_to_cut } => {
                ForeignTable::Columns(ColumnTable::open(path, || {
                    messages::MessageRows::open(path, topic.as_deref(), *is_to_cut)
                })?)
            }
            TableForm::Arrays {
                format,
                rows,
                is_whole,
            } => ForeignTable::Columns(ColumnTable::open(path, || match is_whole {
                true => arrays::ArrayRows::whole(path, *format),
                false => arrays::ArrayRows::open(path, *format, rows.as_deref()),
            })?),
        })
    }

    pub(crate) fn path(&self) -> &Path {
        match self {
            ForeignTable::Delimited(table) => table.path(),
            ForeignTable::Json(table) => table.path(),
            ForeignTable::Files(table) => table.path(),
            ForeignTable::Columns(table) => table.path(),
        }
    }

    pub(crate) fn rows(&self) -> usize {
        match self {
            ForeignTable::Delimited(table) => table.rows(),
            ForeignTable::Json(table) => table.rows(),
            ForeignTable::Files(_) => 1,
            ForeignTable::Columns(table) => table.rows(),
        }
    }

    /// True if the table has a column of exactly this name.
    pub(crate) fn has(&self, name: &str) -> bool {
        match self {
            ForeignTable::Delimited(table) => table.has(name),
            ForeignTable::Json(table) => table.has(name),
            ForeignTable::Files(_) => false,
            ForeignTable::Columns(table) => table.has(name),
        }
    }

    /// Cell of a row (from 0) in the column called `name`, without surrounding blanks; empty if absent.
    ///
    /// # Errors
    /// [`ImportError::Table`] if no row has the column.
    pub(crate) fn cell(&self, row: usize, name: &str) -> Result<Cow<'_, str>, ImportError> {
        match self {
            ForeignTable::Delimited(table) => table.cell(row, name),
            ForeignTable::Json(table) if table.has(name) => Ok(table.cell(row, name)),
            ForeignTable::Columns(table) if table.has(name) => {
                table.cell(row, name).map(Cow::Owned)
            }
            _ => Err(self.no_column(name)),
        }
    }

    /// Unit of a time column as stated by the file, such as `us`; `None` for other columns. The cells are already converted to seconds.
    pub(crate) fn time_unit(&self, name: &str) -> Option<&'static str> {
        match self {
            ForeignTable::Columns(table) => table.time_unit(name),
            _ => None,
        }
    }

    /// Attributes that the file states for a column. Groups of the file with different attributes give one entry each.
    pub(crate) fn stated(&self, name: &str) -> Vec<Stated> {
        match self {
            ForeignTable::Columns(table) => table.stated(name),
            ForeignTable::Delimited(table) => table.stated(name),
            _ => Vec::new(),
        }
    }

    /// Names that may state the unit of `name`, which is the column `base` or a number in its cells. The name of the number precedes the column name,
    /// and the file name replaces the column name `value`.
    pub(crate) fn names_with_units(&self, name: &str, base: &str) -> Vec<String> {
        let at = name.strip_prefix(base).unwrap_or_default();
        let at: Option<usize> = at.trim_matches(['[', ']']).parse().ok();
        let own = at.and_then(|at| self.element_names(base).get(at).cloned());
        let mut names: Vec<String> = own.into_iter().collect();
        names.push(match base {
            "value" => {
                let stem = self.path().file_stem().unwrap_or_default();
                stem.to_string_lossy().into_owned()
            }
            base => base.to_owned(),
        });
        names
    }

    /// Example of a cell whose decimal point may be a digit separator, and the number of such cells in the column.
    pub(crate) fn grouped_digits(&self, name: &str) -> Option<(String, u64)> {
        match self {
            ForeignTable::Delimited(table) => table.grouped_digits(name),
            _ => None,
        }
    }

    /// True if the file states that a column contains integers or lists of integers.
    pub(crate) fn holds_integers(&self, name: &str) -> bool {
        match self {
            ForeignTable::Columns(table) => table.holds_integers(name),
            ForeignTable::Json(table) => table.holds_integers(name),
            ForeignTable::Delimited(_) | ForeignTable::Files(_) => false,
        }
    }

    /// Name of a row; `None` if rows have no names. Rows that are members of a JSON object have names.
    pub(crate) fn key(&self, row: usize) -> Option<&str> {
        match self {
            ForeignTable::Json(table) => table.key(row),
            _ => None,
        }
    }

    /// Place of a row and column, for messages.
    pub(crate) fn place(&self, row: usize, name: &str) -> Place {
        match self {
            ForeignTable::Delimited(table) => table.place(row, name),
            ForeignTable::Json(table) => named(table.place(row), name),
            ForeignTable::Files(table) => Place::file(table.path()),
            ForeignTable::Columns(table) => {
                named(Place::file(table.path()).in_row(row as u64), name)
            }
        }
    }

    /// Names of all columns; empty if the form of the table does not list them.
    pub(crate) fn names(&self) -> Vec<String> {
        match self {
            ForeignTable::Delimited(table) => table.names().to_vec(),
            ForeignTable::Json(table) => table.names(),
            ForeignTable::Files(_) => Vec::new(),
            ForeignTable::Columns(table) => table.names(),
        }
    }

    /// Clip and frame number of each row for the LeRobot feature `key`. Clip paths are relative to the folder of the table.
    pub(crate) fn clips(&self, key: &str) -> Result<Vec<(String, u64)>, ImportError> {
        match self {
            ForeignTable::Columns(table) => table.clips(key),
            _ => Ok(Vec::new()),
        }
    }

    /// Distance for each code of the LeRobot feature `key`; `None` if the feature is not a depth map.
    pub(crate) fn depth(&self, key: &str) -> Option<DepthCodes> {
        match self {
            ForeignTable::Columns(table) => table.depth(key),
            _ => None,
        }
    }

    /// Reads columns in advance, if reading them together is faster.
    pub(crate) fn read_ahead(&self, names: &[&str]) -> Result<(), ImportError> {
        match self {
            ForeignTable::Columns(table) => table.read_ahead(names),
            _ => Ok(()),
        }
    }

    /// Adds the number of unwritten chunks of each array of the columns `names` to `into`, by file and array.
    pub(crate) fn count_absent_chunks(
        &self,
        folder: &SourceFolder,
        names: &[&str],
        into: &mut BTreeMap<String, u64>,
    ) -> Result<(), ImportError> {
        let ForeignTable::Columns(table) = self else {
            return Ok(());
        };
        for (array, count) in table.absent_chunks(names)? {
            into.insert(folder.inside(self.path(), &array), count);
        }
        Ok(())
    }

    /// Columns that a draft of a map examines.
    pub(crate) fn columns(&self) -> Vec<String> {
        match self {
            ForeignTable::Json(table) => table.leaves(),
            _ => self.names(),
        }
    }

    /// Columns whose numbers denote classes, each with the list of class names that the file states.
    pub(crate) fn classes(&self) -> Vec<(String, Vec<String>)> {
        match self {
            ForeignTable::Columns(table) => table.classes(),
            _ => Vec::new(),
        }
    }

    /// Names of the numbers in a column; empty if the file does not state them.
    pub(crate) fn element_names(&self, column: &str) -> Vec<String> {
        match self {
            ForeignTable::Columns(table) => table.element_names(column),
            _ => Vec::new(),
        }
    }

    /// Unread items of the file, each with the reason.
    pub(crate) fn unread(&self) -> Vec<String> {
        match self {
            ForeignTable::Columns(table) => table.unread(),
            _ => Vec::new(),
        }
    }

    /// Columns that seem to contain pictures.
    pub(crate) fn picture_columns(&self) -> Vec<PictureColumn> {
        match self {
            ForeignTable::Columns(table) => table.picture_columns(),
            _ => Vec::new(),
        }
    }

    /// Pictures of the rows, by row number.
    pub(crate) fn pictures(&self, names: &FrameNames) -> Result<Arc<dyn Pictures>, ImportError> {
        match self {
            ForeignTable::Columns(table) => table.pictures(names),
            _ => Err(ImportError::table(
                self.path(),
                "a table of this form holds no pictures: name picture files by `column` or `pattern`, or an array of another \
                    file by `array = { file = \"…\" }`",
            )),
        }
    }

    /// Error for a missing column `name`. Lists the existing columns.
    pub(crate) fn no_column(&self, name: &str) -> ImportError {
        if let ForeignTable::Columns(table) = self
            && let Some(problem) = table.why_absent(name)
        {
            return ImportError::table(self.place(0, name).without_row(), problem);
        }
        let names = self.names();
        let guess = nearest(name, names.iter().map(String::as_str));
        let guess = guess.map_or_else(String::new, |guess| {
            format!(", did you mean `{}`", shown(guess))
        });
        let known = match names.is_empty() {
            true => "the table has no columns of its own".to_owned(),
            false => format!("the columns are {}", listed(&names)),
        };
        table_error!(self.path(), "no column `{}`{guess}? {known}", shown(name))
    }
}
/// Adds the column `name` to `place`, unless `name` is empty.
fn named(place: Place, name: &str) -> Place {
    match name {
        "" => place,
        name => place.in_column(name),
    }
}
