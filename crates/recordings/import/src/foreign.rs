//! Tables as other programs wrote them: rows of cells that are asked for by the name of a column.

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
mod pictures;
pub(crate) mod tar;
mod webdataset;

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;
use std::path::Path;
use std::sync::Arc;

use taceva_arrays::ArrayFormat;

use crate::csv_table::text_form::TextForm;
use crate::frame_names::FrameNames;
use crate::source_folder::SourceFolder;
use taceva_core::nearest;
use taceva_dataset::internal::{listed, shown};
use taceva_dataset::{DatasetError, Place};
use taceva_tables::{ArrowTable, DepthCodes, ParquetTable};

pub(crate) use arrays::{ArrayPictures, stated};
pub(crate) use clips::ClipPictures;
pub(crate) use columns::{ColumnTable, PictureColumn, PictureKind, Stated};
pub(crate) use delimited::DelimitedTable;
pub(crate) use depth_pixels::DepthPixels;
pub(crate) use file_series::SeveralPictures;
pub(crate) use files::FileRows;
pub(crate) use json::JsonRows;
pub(crate) use messages::{is_recording, topics};
pub(crate) use pictures::{Picture, Pictures};

/// A table of any form.
#[derive(Debug)]
pub(crate) enum ForeignTable {
    Delimited(DelimitedTable),
    Json(JsonRows),
    Files(FileRows),
    Columns(ColumnTable),
}

/// How a table is written.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum TableForm {
    /// Cells between separators.
    Delimited(TextForm),
    /// JSON, whose rows are what the pointer leads to: a step `*` stands for each member, the empty pointer for the whole.
    Json {
        rows: Option<String>,
    },
    /// A JSON value a line.
    JsonLines,
    /// No table: every file is a row.
    Files,
    /// Arrays, whose rows are what they hold at one place of the first axis; `rows` names a group, several with `*`, or a table in it.
    Arrays {
        format: ArrayFormat,
        rows: Option<String>,
        /// The file is one row, each array of it a cell.
        is_whole: bool,
    },
    Parquet,
    /// A stream or a file of Arrow.
    Arrow,
    /// The messages of a topic of a recording: MCAP, rosbag2 or a bag of ROS 1.
    Messages {
        topic: Option<String>,
    },
    /// A folder as LeRobot writes it, versions 2.1 and 3.0.
    LeRobot,
    /// A shard of WebDataset.
    WebDataset,
    /// The frames of a clip: so many a second, or at the times that the clip states; the first at a time in seconds.
    Clip {
        rate: Option<f64>,
        start_s: f64,
    },
}

/// The message of an error about the file at `path`, without the path: the error around it names that.
pub(crate) fn said(path: &Path, error: &impl fmt::Display) -> String {
    let text = error.to_string();
    let rest = text.strip_prefix(&format!("{}: ", path.display()));
    rest.unwrap_or(&text).to_owned()
}

impl ForeignTable {
    /// The table at `path`.
    pub(crate) fn read(path: &Path, form: &TableForm) -> Result<ForeignTable, DatasetError> {
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
                    clip_rows::ClipRows::open(path, *rate, *start_s)
                })?)
            }
            TableForm::WebDataset => {
                ForeignTable::Columns(ColumnTable::open(path, || webdataset::Shard::open(path))?)
            }
            TableForm::Messages { topic } => {
                ForeignTable::Columns(ColumnTable::open(path, || {
                    messages::MessageRows::open(path, topic.as_deref())
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

    /// Whether there is a column of exactly this name.
    pub(crate) fn has(&self, name: &str) -> bool {
        match self {
            ForeignTable::Delimited(table) => table.has(name),
            ForeignTable::Json(table) => table.has(name),
            ForeignTable::Files(_) => false,
            ForeignTable::Columns(table) => table.has(name),
        }
    }

    /// What a row (from 0) has in the column called `name`, without surrounding blanks; empty where it has nothing.
    ///
    /// # Errors
    /// [`DatasetError::Table`] if no row has such a column.
    pub(crate) fn cell(&self, row: usize, name: &str) -> Result<Cow<'_, str>, DatasetError> {
        match self {
            ForeignTable::Delimited(table) => table.cell(row, name),
            ForeignTable::Json(table) if table.has(name) => Ok(table.cell(row, name)),
            ForeignTable::Columns(table) if table.has(name) => {
                table.cell(row, name).map(Cow::Owned)
            }
            _ => Err(self.no_column(name)),
        }
    }

    /// The unit in which the file counts the times in a column, where it says that they are times: `us`. Their cells are in seconds.
    pub(crate) fn time_unit(&self, name: &str) -> Option<&'static str> {
        match self {
            ForeignTable::Columns(table) => table.time_unit(name),
            _ => None,
        }
    }

    /// What the file says of the numbers in a column; in each of its groups where that differs.
    pub(crate) fn stated(&self, name: &str) -> Vec<Stated> {
        match self {
            ForeignTable::Columns(table) => table.stated(name),
            ForeignTable::Delimited(table) => table.stated(name),
            _ => Vec::new(),
        }
    }

    /// The names that may say the unit of `name`, a number in the column `base`: its own name, that of the column, that of the file where columns
    /// have none.
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

    /// Cell of a table of text whose point may group digits, and the number of such cells in the column.
    pub(crate) fn grouped_digits(&self, name: &str) -> Option<(String, u64)> {
        match self {
            ForeignTable::Delimited(table) => table.grouped_digits(name),
            _ => None,
        }
    }

    /// Whether the file says that a column holds integers, or lists of them.
    pub(crate) fn holds_integers(&self, name: &str) -> bool {
        match self {
            ForeignTable::Columns(table) => table.holds_integers(name),
            ForeignTable::Json(table) => table.holds_integers(name),
            ForeignTable::Delimited(_) | ForeignTable::Files(_) => false,
        }
    }

    /// The name of a row, where rows have names: the member of a JSON object.
    pub(crate) fn key(&self, row: usize) -> Option<&str> {
        match self {
            ForeignTable::Json(table) => table.key(row),
            _ => None,
        }
    }

    /// Where a row stands, in the column called `name`.
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

    /// The names of all columns, where a table lists them.
    pub(crate) fn names(&self) -> Vec<String> {
        match self {
            ForeignTable::Delimited(table) => table.names().to_vec(),
            ForeignTable::Json(table) => table.names(),
            ForeignTable::Files(_) => Vec::new(),
            ForeignTable::Columns(table) => table.names(),
        }
    }

    /// For each row the clip that `key` names, relative to the folder of the table, and the frame in it.
    pub(crate) fn clips(&self, key: &str) -> Result<Vec<(String, u64)>, DatasetError> {
        match self {
            ForeignTable::Columns(table) => table.clips(key),
            _ => Ok(Vec::new()),
        }
    }

    /// The distances of the codes of `key`, where it is a depth map.
    pub(crate) fn depth(&self, key: &str) -> Option<DepthCodes> {
        match self {
            ForeignTable::Columns(table) => table.depth(key),
            _ => None,
        }
    }

    /// Reads columns that will be asked for, where that is faster together.
    pub(crate) fn read_ahead(&self, names: &[&str]) -> Result<(), DatasetError> {
        match self {
            ForeignTable::Columns(table) => table.read_ahead(names),
            _ => Ok(()),
        }
    }

    /// Counts the chunks that were never written of the arrays that are these columns, by file and array.
    pub(crate) fn count_absent_chunks(
        &self,
        folder: &SourceFolder,
        names: &[&str],
        into: &mut BTreeMap<String, u64>,
    ) -> Result<(), DatasetError> {
        let ForeignTable::Columns(table) = self else {
            return Ok(());
        };
        for (array, count) in table.absent_chunks(names)? {
            into.insert(folder.inside(self.path(), &array), count);
        }
        Ok(())
    }

    /// The columns that a draft of a map looks at.
    pub(crate) fn columns(&self) -> Vec<String> {
        match self {
            ForeignTable::Json(table) => table.leaves(),
            _ => self.names(),
        }
    }

    /// The closed lists of classes that numbers of columns are positions in, as the file states them.
    pub(crate) fn classes(&self) -> Vec<(String, Vec<String>)> {
        match self {
            ForeignTable::Columns(table) => table.classes(),
            _ => Vec::new(),
        }
    }

    /// What the numbers of a column are called, as the file states it; empty where it does not.
    pub(crate) fn element_names(&self, column: &str) -> Vec<String> {
        match self {
            ForeignTable::Columns(table) => table.element_names(column),
            _ => Vec::new(),
        }
    }

    /// What of its file is not read and is no column, each with the reason.
    pub(crate) fn unread(&self) -> Vec<String> {
        match self {
            ForeignTable::Columns(table) => table.unread(),
            _ => Vec::new(),
        }
    }

    /// What of it seems to hold pictures.
    pub(crate) fn picture_columns(&self) -> Vec<PictureColumn> {
        match self {
            ForeignTable::Columns(table) => table.picture_columns(),
            _ => Vec::new(),
        }
    }

    /// The pictures that belong to its rows, by the number of the row.
    pub(crate) fn pictures(&self, names: &FrameNames) -> Result<Arc<dyn Pictures>, DatasetError> {
        match self {
            ForeignTable::Columns(table) => table.pictures(names),
            _ => Err(DatasetError::Table {
                place: Place::file(self.path()),
                problem: "there are no pictures in a table of this form: files are named by `column` or `pattern`, an array of another file is \
                          `array = { file = \"…\" }`"
                    .to_owned(),
            }),
        }
    }

    /// The error that there is no column called `name`; it lists those there are.
    pub(crate) fn no_column(&self, name: &str) -> DatasetError {
        if let ForeignTable::Columns(table) = self
            && let Some(problem) = table.why_absent(name)
        {
            return DatasetError::Table {
                place: self.place(0, name).without_row(),
                problem,
            };
        }
        let names = self.names();
        let guess = nearest(name, names.iter().map(String::as_str));
        let guess = guess.map_or_else(String::new, |guess| {
            format!(", did you mean `{}`", shown(guess))
        });
        let known = match names.is_empty() {
            true => "it has none of its own".to_owned(),
            false => format!("the columns are {}", listed(&names)),
        };
        DatasetError::Table {
            place: Place::file(self.path()),
            problem: format!("no column `{}`{guess}? {known}", shown(name)),
        }
    }
}
/// `place` in the column called `name`, if it has a name.
fn named(place: Place, name: &str) -> Place {
    match name {
        "" => place,
        name => place.in_column(name),
    }
}
