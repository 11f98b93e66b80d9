//! Import map: the column and unit of each channel, and facts about the recording.

mod axes;
mod check;
mod columns;
mod drop;
mod drop_schema;
mod frame_schema;
mod instruments;
mod join;
mod matrix;
mod path_pattern;
mod rotation;
mod schema;
mod sections;
mod signals;
mod table_schema;
mod tasks;
#[cfg(test)]
mod tests;
mod zero;

use std::collections::BTreeMap;
use std::path::Path;

use taceva_core::Channels;

use crate::csv_table::text_form::TextForm;
use crate::error::ImportError;
use crate::foreign::TableForm;
use taceva_dataset::RecordingFacts;
use taceva_dataset::internal::read_toml_text;

pub(crate) use crate::frame_names::{OWN_ROW, reference_attribute};
pub(crate) use join::{JoinBy, JoinMap, Lag, Pick, TimeJoin, Unmatched};
pub(crate) use matrix::{MatrixMap, MatrixRows};
pub(crate) use path_pattern::PathPattern;
pub(crate) use rotation::{RotationMap, turn_in};
pub(crate) use signals::{SignalsFrom, SignalsMap};
pub(crate) use table_schema::converter;
pub(crate) use tasks::{TaskMap, no_name};
pub(crate) use zero::{GravityMap, ZeroMap, ZeroRows};

pub use crate::frame_names::{
    ArrayFrames, ArrayLayout, FrameMap, FrameNames, PixelRange, VideoFrames,
};
pub(crate) use columns::OriginMap;
pub use columns::{ColumnMap, IdMap, TimeMap};
pub use drop::{DropRules, DroppedRow, Placeholder};

/// Checked import map: the source and unit of each channel, and facts about the recording.
///
/// ```
/// let map = taceva_import::ImportMap::parse(
///     "map.toml".as_ref(),
///     r#"
///     map_version = 2
///     table = "labels.csv"
///     [columns]
///     Fz = { from = "force", unit = "mN" }
///     [time]
///     clock = "unknown"
///     [sensor]
///     model = "my gel"
///     serial = "unknown"
///     gel = "unknown"
///     opaque = true
///     "#,
/// )?;
/// assert_eq!(map.channels.len(), 1);
/// # Ok::<(), taceva_import::ImportError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ImportMap {
    /// Table of labels, or a pattern with `*`, relative to the source folder.
    pub table: String,
    /// Sources of the frames, one for each view; empty for a dataset without frames.
    pub frames: Vec<FrameMap>,
    /// Channels of the dataset, in order.
    pub channels: Channels,
    /// Source column of each channel.
    pub columns: Vec<ColumnMap>,
    /// Columns of the ids of samples, such as the contact point.
    pub ids: IdMap,
    /// Text columns kept for splits: name and column.
    pub attributes: BTreeMap<String, String>,
    /// Column and unit of the time; `None` without a time.
    pub time: Option<TimeMap>,
    /// Rules for rows that are left out.
    pub drop: DropRules,
    /// Sensor, clock, source and footprint.
    pub facts: RecordingFacts,
    /// Form of the table.
    pub(crate) form: TableForm,
    /// Coordinate frame to which the rows of the table are restricted.
    pub(crate) frame_id: Option<String>,
    /// True if unwritten elements of an HDF5 array are read as the fill value.
    pub(crate) is_filled: bool,
    /// Labels in the path of the table, in the file of a row, or in a cell.
    pub(crate) path: Option<PathPattern>,
    pub(crate) joins: Vec<JoinMap>,
    pub(crate) matrices: Vec<MatrixMap>,
    /// Source of the taxel values; `None` for a dataset without signals.
    pub(crate) signals: Option<SignalsMap>,
    /// Origin of the rows of an exported table.
    pub(crate) origin: Option<OriginMap>,
    /// Text columns with a closed list of values: name, column and list.
    pub(crate) classes: BTreeMap<String, ClassMap>,
    /// Tasks, sorted by name.
    pub(crate) tasks: Vec<TaskMap>,
    /// Channels that are parts of one rotation.
    pub(crate) rotations: Vec<RotationMap>,
    /// Rows at zero force, whose mean is subtracted.
    pub(crate) zero: Option<ZeroMap>,
    /// Tool whose weight is subtracted.
    pub(crate) gravity: Option<GravityMap>,
}

/// Column with a closed list of values.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct ClassMap {
    pub(crate) from: String,
    /// Class names. A number in the column is a position in this list, from 0, unless the number itself is a name.
    pub(crate) names: Vec<String>,
}

impl ClassMap {
    /// Position in the list that a cell contains; `None` if the cell is not a position in the list.
    pub(crate) fn position(&self, cell: &str) -> Option<usize> {
        let position = cell.parse::<usize>().ok();
        position.filter(|position| *position < self.names.len())
    }

    /// First name that is also the position of another name, and that position.
    pub(crate) fn ambiguous(&self) -> Option<(&str, usize)> {
        let mut names = self.names.iter().enumerate();
        names.find_map(|(at, name)| {
            let position = self.position(name)?;
            (position != at).then_some((name.as_str(), position))
        })
    }
}

impl ImportMap {
    /// Map of `table` without channels, frames and ids.
    pub fn new(table: impl Into<String>, facts: RecordingFacts) -> ImportMap {
        ImportMap {
            table: table.into(),
            frames: Vec::new(),
            channels: Channels::default(),
            columns: Vec::new(),
            ids: IdMap::default(),
            attributes: BTreeMap::new(),
            time: None,
            drop: DropRules::default(),
            facts,
            form: TableForm::Delimited(TextForm::new(true)),
            frame_id: None,
            is_filled: false,
            path: None,
            joins: Vec::new(),
            matrices: Vec::new(),
            signals: None,
            origin: None,
            classes: BTreeMap::new(),
            tasks: Vec::new(),
            rotations: Vec::new(),
            zero: None,
            gravity: None,
        }
    }

    /// Reads the map at `path`.
    ///
    /// # Errors
    /// [`ImportError::Dataset`] naming the line, or if the file is not regular, exceeds 1 MiB or cannot be read.
    pub fn read(path: &Path) -> Result<ImportMap, ImportError> {
        ImportMap::parse(path, &read_toml_text(path)?)
    }

    /// Parses the map in `text`. `path` only appears in messages.
    ///
    /// # Errors
    /// [`ImportError::Dataset`] naming the line.
    pub fn parse(path: &Path, text: &str) -> Result<ImportMap, ImportError> {
        Ok(schema::checked(path, text)?)
    }
}
