//! Forms of tables of other programs.

use taceva_arrays::ArrayFormat;

use crate::csv_table::text_form::TextForm;

/// Form of a table.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum TableForm {
    /// Text with separators between cells.
    Delimited(TextForm),
    /// JSON with a pointer to the rows. A step `*` matches each member, and the empty pointer denotes the whole value.
    Json {
        rows: Option<String>,
    },
    /// One JSON value per line.
    JsonLines,
    /// No table. Each file is a row.
    Files,
    /// Arrays, with rows along the first axis. `rows` names a group, several groups with `*`, or a table in the file.
    Arrays {
        format: ArrayFormat,
        rows: Option<String>,
        /// True if the file is a single row, with each array as a cell.
        is_whole: bool,
    },
    Parquet,
    /// Arrow stream or file.
    Arrow,
    /// Messages of one topic of a recording: MCAP, rosbag2 or a ROS 1 bag.
    Messages {
        topic: Option<String>,
        /// True if the complete messages of a truncated recording are read; false if truncation is an error.
        is_to_cut: bool,
    },
    /// LeRobot folder, version 2.1 or 3.0.
    LeRobot,
    /// WebDataset shard.
    WebDataset,
    /// Frames of a clip at the rate `rate`, Hz, or at the times stated by the clip. The first frame is at `start_s`, s.
    Clip {
        rate: Option<f64>,
        start_s: f64,
    },
}
