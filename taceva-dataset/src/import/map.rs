//! The map of an import: which column is which channel, in which unit, and which facts are unknown.

mod written;

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;
use taceva_core::{Channels, SourceUnit};

use crate::decode::ChannelOrder;
use crate::error::DatasetError;
use crate::store::RecordingFacts;
use crate::toml_file::read_toml_text;

/// A checked map.
///
/// ```
/// let map = taceva_dataset::ImportMap::parse(
///     "map.toml".as_ref(),
///     r#"
///     map_version = 1
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
/// # Ok::<(), taceva_dataset::DatasetError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ImportMap {
    /// Table of labels, or a pattern with `*`, relative to the source folder.
    pub table: String,
    /// Where the frames are; without it the dataset has none.
    pub frame: Option<FrameMap>,
    /// The channels, in order.
    pub channels: Channels,
    /// For each channel the column it comes from.
    pub columns: Vec<ColumnMap>,
    /// The columns of the ids.
    pub ids: IdMap,
    /// Text columns kept for splits: name and column.
    pub attributes: BTreeMap<String, String>,
    /// The column of the time, and its unit.
    pub time: Option<TimeMap>,
    /// Which rows are left out.
    pub drop: DropRules,
    /// Sensor, clock, source and footprint.
    pub facts: RecordingFacts,
}

/// The column a channel comes from.
///
/// ```
/// use taceva_core::SourceUnit;
/// use taceva_dataset::ColumnMap;
///
/// let mut column = ColumnMap::new("force", SourceUnit::parse("mN")?);
/// column.is_negated = true;
/// assert_eq!(column.from, "force");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ColumnMap {
    /// Its name in the table.
    pub from: String,
    /// The unit it is in there.
    pub unit: SourceUnit,
    /// Whether its sign is turned.
    pub is_negated: bool,
}

impl ColumnMap {
    /// The column `from`, in `unit`, with its sign as it is.
    pub fn new(from: impl Into<String>, unit: SourceUnit) -> ColumnMap {
        ColumnMap {
            from: from.into(),
            unit,
            is_negated: false,
        }
    }
}

/// Where the frames are.
///
/// ```
/// use taceva_dataset::{ChannelOrder, FrameMap, FrameNames};
///
/// let frames = FrameMap::new(FrameNames::Column("file".into()), ChannelOrder::Gray);
/// assert_eq!((frames.folder, frames.reference), (None, None));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct FrameMap {
    /// How a row names its frame.
    pub names: FrameNames,
    /// The folder that file names are relative to, relative to the source folder; `None`: that of the table.
    pub folder: Option<String>,
    /// The order of the colours in the files.
    pub channel_order: ChannelOrder,
    /// The frame without contact, relative to the source folder; `None` if none is known.
    pub reference: Option<String>,
}

impl FrameMap {
    /// Frames in files relative to the folder of the table, with colours in `channel_order` and without a frame without contact.
    pub fn new(names: FrameNames, channel_order: ChannelOrder) -> FrameMap {
        FrameMap {
            names,
            folder: None,
            channel_order,
            reference: None,
        }
    }
}

/// How a row names its frame.
///
/// ```
/// use taceva_dataset::FrameNames;
///
/// // A row whose column `n` holds 7 has the frame images/image_7.png.
/// let names = FrameNames::Pattern("images/image_{n}.png".into());
/// assert_ne!(names, FrameNames::Column("n".into()));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FrameNames {
    /// A column holds the path.
    Column(String),
    /// A path in which `{column}` stands for the cell of that column.
    Pattern(String),
    /// Frames in one array.
    Array(ArrayFrames),
}

/// Frames in one array.
///
/// ```
/// use taceva_dataset::{ArrayFrames, FrameNames};
///
/// let names = FrameNames::Array(ArrayFrames::new("frames.npy", "frame"));
/// assert!(matches!(names, FrameNames::Array(array) if array.index == "frame"));
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ArrayFrames {
    /// The `.npy` file, relative to the source folder.
    pub file: String,
    /// The column that holds the position in the array, from 0.
    pub index: String,
}

impl ArrayFrames {
    /// The frames in the `.npy` file `file`; the column `index` holds the position in the array.
    pub fn new(file: impl Into<String>, index: impl Into<String>) -> ArrayFrames {
        ArrayFrames {
            file: file.into(),
            index: index.into(),
        }
    }
}

/// The columns of the ids.
///
/// ```
/// use taceva_dataset::IdMap;
///
/// let mut ids = IdMap::default();
/// ids.point_id = vec!["x".into(), "y".into()];
/// assert_eq!(ids.sample, None);
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq, Deserialize)]
#[non_exhaustive]
#[serde(deny_unknown_fields, default)]
pub struct IdMap {
    /// The name of a sample; absent: the number of its row, from 0.
    pub sample: Option<String>,
    /// The contact location; several columns are joined with `:`.
    #[serde(deserialize_with = "one_or_more")]
    pub point_id: Vec<String>,
    /// The sensor unit.
    pub unit_id: Option<String>,
    /// The lighting scene or the like.
    pub scene: Option<String>,
    /// The depth level.
    pub depth_step: Option<String>,
    /// The number of the repeat.
    pub repeat: Option<String>,
    /// Load or unload.
    pub phase: Option<String>,
    /// The part of a declared split.
    pub part: Option<String>,
    /// The relief of a grating: `line` or `dot`.
    pub kind: Option<String>,
    /// The spacing of a grating, in mm as decimal text.
    pub spacing_mm: Option<String>,
}

/// The column of the time.
///
/// ```
/// use taceva_core::SourceUnit;
/// use taceva_dataset::TimeMap;
///
/// let time = TimeMap::new("t", SourceUnit::parse("ms")?);
/// assert_eq!(time.column, "t");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct TimeMap {
    /// Its name in the table.
    pub column: String,
    /// The unit it is in there.
    pub unit: SourceUnit,
}

impl TimeMap {
    /// The column `column`, in `unit`.
    pub fn new(column: impl Into<String>, unit: SourceUnit) -> TimeMap {
        TimeMap {
            column: column.into(),
            unit,
        }
    }
}

/// Which rows are left out; each is counted.
///
/// ```
/// use taceva_dataset::{DropRules, Placeholder};
///
/// let mut rules = DropRules::default();
/// rules.placeholders = vec![Placeholder::new("Fx", 0.0), Placeholder::new("Fz", 0.0)];
/// assert!(rules.quality_flags.is_empty());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct DropRules {
    /// The column of flags, separated by `;` or blanks.
    pub flag_column: String,
    /// A row with one of these is left out.
    pub quality_flags: Vec<String>,
    /// A row whose frame is called one of these is left out.
    pub frames_named: Vec<String>,
    /// A row in which all these columns hold these numbers is left out.
    pub placeholders: Vec<Placeholder>,
}

/// A number that stands for "not measured".
///
/// ```
/// use taceva_dataset::Placeholder;
///
/// assert_eq!(Placeholder::new("Fz", -1.0).channel, "Fz");
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Placeholder {
    /// The channel.
    pub channel: String,
    /// The number in the table, before it is converted.
    pub number: f64,
}

impl Placeholder {
    /// The number `number` in the column of `channel`.
    pub fn new(channel: impl Into<String>, number: f64) -> Placeholder {
        Placeholder {
            channel: channel.into(),
            number,
        }
    }
}

impl ImportMap {
    /// A map of `table` without channels, frames and ids.
    pub fn new(table: impl Into<String>, facts: RecordingFacts) -> ImportMap {
        ImportMap {
            table: table.into(),
            frame: None,
            channels: Channels::default(),
            columns: Vec::new(),
            ids: IdMap::default(),
            attributes: BTreeMap::new(),
            time: None,
            drop: DropRules::default(),
            facts,
        }
    }

    /// The map at `path`.
    ///
    /// # Errors
    /// [`DatasetError::Toml`] naming the line; [`DatasetError::Path`] if it is no regular file or above 1 MiB;
    /// [`DatasetError::Io`].
    pub fn read(path: &Path) -> Result<ImportMap, DatasetError> {
        ImportMap::parse(path, &read_toml_text(path)?)
    }

    /// The map that `text` says; `path` is only named in messages.
    ///
    /// # Errors
    /// [`DatasetError::Toml`] naming the line.
    pub fn parse(path: &Path, text: &str) -> Result<ImportMap, DatasetError> {
        written::checked(path, text)
    }
}

fn one_or_more<'de, D: serde::Deserializer<'de>>(deserializer: D) -> Result<Vec<String>, D::Error> {
    struct Names;

    impl<'de> serde::de::Visitor<'de> for Names {
        type Value = Vec<String>;

        fn expecting(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            f.write_str("a column or a list of columns")
        }
        fn visit_str<E: serde::de::Error>(self, name: &str) -> Result<Vec<String>, E> {
            Ok(vec![name.to_owned()])
        }
        fn visit_seq<A: serde::de::SeqAccess<'de>>(
            self,
            mut names: A,
        ) -> Result<Vec<String>, A::Error> {
            let mut list = Vec::new();
            while let Some(name) = names.next_element()? {
                list.push(name);
            }
            Ok(list)
        }
    }

    deserializer.deserialize_any(Names)
}

#[cfg(test)]
mod tests {
    use super::*;

    const GOOD: &str = r#"map_version = 1
table = "labels.csv"
[frame]
column = "file"
channel_order = "gray"
reference = "unknown"
[columns]
Fz = { from = "Fz_N", unit = "N", sign = -1 }
Rx = { from = "rx", unit = "rad" }
[ids]
sample = "sample"
point_id = ["x", "y"]
[time]
clock = "unknown"
[sensor]
model = "TacTip"
serial = "unknown"
gel = "unknown"
opaque = "unknown"
"#;

    fn message(from: &str, to: &str) -> String {
        assert!(GOOD.contains(from), "{from}");
        ImportMap::parse(Path::new("m.toml"), &GOOD.replace(from, to))
            .expect_err("wrong")
            .to_string()
    }

    #[test]
    fn a_whole_map_is_understood() {
        let map = ImportMap::parse(Path::new("m.toml"), GOOD).expect("good");
        assert_eq!(map.ids.point_id, ["x", "y"]);
        assert!(map.columns[0].is_negated && !map.columns[1].is_negated);
        assert_eq!(map.facts.sensor.opaque.known(), None);
        assert_eq!(map.frame.expect("frames").reference, None);
    }

    #[test]
    fn each_mistake_names_its_line_and_what_is_accepted() {
        for (from, to, expected) in [
            (
                "map_version = 1",
                "map_version = 2",
                "line 1: map version 2",
            ),
            (
                "\"N\"",
                "\"newton\"",
                "line 8: unknown unit `newton`, expected one of mm",
            ),
            (
                "\"N\"",
                "\"mm\"",
                "line 8: channel `Fz` is kept in N, not in mm",
            ),
            (
                "sign = -1",
                "sign = 2",
                "line 8: sign = 2, expected 1 or -1",
            ),
            (
                ", unit = \"N\"",
                "",
                "line 8: the key `unit` is missing; every column states",
            ),
            (
                "clock = \"unknown\"",
                "",
                "the key `clock` is missing; write \"unknown\"",
            ),
            (
                "reference = \"unknown\"\n",
                "",
                "the key `reference` is missing; write \"unknown\"",
            ),
            (
                "serial = \"unknown\"\n",
                "",
                "the key `serial` is missing; write \"unknown\"",
            ),
            (
                "gel = \"unknown\"\n",
                "",
                "the key `gel` is missing; write \"unknown\"",
            ),
            (
                "opaque = \"unknown\"",
                "opaque = \"maybe\"",
                "true, false or \"unknown\"",
            ),
            (
                "column = \"file\"",
                "colunm = \"file\"",
                "line 4: `colunm`: unknown key, did you mean `column`?",
            ),
            (
                "column = \"file\"",
                "column = \"file\"\narray = \"x.npy\"",
                "expected one of the three",
            ),
            (
                "\"labels.csv\"",
                "\"../labels.csv\"",
                "line 2: `../labels.csv`: `..` is not followed",
            ),
            ("Rx =", "phase =", "line 9: `phase` is the name of an id"),
            (
                "clock = \"unknown\"",
                "clock = \"unix\"\ncolumn = \"t\"",
                "no `unit`",
            ),
            (
                "clock = \"unknown\"",
                "clock = \"unix\"\ncolumn = \"t\"\nunit = \"mm\"",
                "no unit of time",
            ),
        ] {
            let message = message(from, to);
            assert!(message.contains(expected), "{from} → {to}: {message}");
        }
    }

    #[test]
    fn a_map_above_one_mebibyte_is_not_read() {
        let folder = tempfile::tempdir().expect("a folder");
        let path = folder.path().join("m.toml");
        std::fs::write(&path, "#".repeat((1 << 20) + 1)).expect("written");
        let message = ImportMap::read(&path).expect_err("large").to_string();
        assert!(message.contains("more than the 1048576"), "{message}");
    }
}
