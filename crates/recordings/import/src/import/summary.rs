//! Summary of an import: numbers of items read, kept, converted and left out.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use taceva_core::{SignalInfo, SourceUnit, Unit};

use super::suspicion::Suspicion;
use super::warning::ImportWarning;
use taceva_dataset::{ChannelOrder, LeftOut, names_quality};

/// Summary of an import.
///
/// ```
/// # use taceva_core::{Channel, Channels, Clock, SourceUnit};
/// # use taceva_dataset::{RecordingFacts, SensorFacts, Source};
/// # use taceva_import::{ColumnMap, ImportMap, ImportPlan};
/// # let folder = tempfile::tempdir()?;
/// std::fs::write(folder.path().join("labels.csv"), "force\n1500\n2000\n")?;
/// let facts = RecordingFacts::new(Source::Recorded, Clock::Unknown, SensorFacts::new("my gel"));
/// let mut map = ImportMap::new("labels.csv", facts);
/// map.channels = Channels::new([Channel::FZ])?;
/// map.columns = vec![ColumnMap::new("force", SourceUnit::parse("mN")?)];
/// let plan = ImportPlan::new(folder.path(), &map)?;
///
/// let summary = plan.summary();
/// assert_eq!((summary.rows_read, summary.rows_kept, summary.tables.len()), (2, 2, 1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ImportSummary {
    /// Main tables, in reading order.
    pub tables: Vec<PathBuf>,
    /// Number of files, if each file is one row; 0 if the map names a table.
    pub files: u64,
    /// Number of rows in the main tables.
    pub rows_read: u64,
    /// Number of rows that become samples of the dataset.
    pub rows_kept: u64,
    /// Number of contact points that the kept rows name; 0 if the map names no contact point.
    pub points: u64,
    /// Number of rows dropped by each rule. Several rules may drop the same row.
    pub dropped: BTreeMap<String, u64>,
    /// Numbers of matched and unmatched rows of each join.
    pub joins: Vec<JoinSummary>,
    /// Conversion and number of values of each channel.
    pub conversions: Vec<Conversion>,
    /// Tasks, each with its kind, number of labels and cluster, in words.
    pub tasks: Vec<String>,
    /// Zeros subtracted from forces and torques; empty if the map sets none.
    pub zeros: Vec<ZeroSummary>,
    /// Weight subtracted from forces and torques, in words; `None` if no weight is subtracted.
    pub gravity: Option<String>,
    /// Grid and unit of the signals; `None` without signals.
    pub signals: Option<SignalInfo>,
    /// Frames of each view; empty without frames.
    pub frames: Vec<FrameSummary>,
    /// Number of images in the lab's folder that no row names.
    pub unnamed_images: u64,
    /// The first 20 images that no row names, sorted.
    pub first_unnamed_images: Vec<PathBuf>,
    /// True if there may be more images without a row, because the search ended at the maximum number of files.
    pub has_more_files: bool,
    /// Number of frames in arrays and clips that no row uses, by file.
    pub unused_frames: BTreeMap<String, u64>,
    /// Number of unwritten chunks, which are read as the fill value, by file and array.
    pub absent_chunks: BTreeMap<String, u64>,
    /// Columns of the tables that the map does not mention, sorted.
    pub unmentioned_columns: BTreeSet<String>,
    /// Unread topics of recordings, each with the reason.
    pub unread_topics: BTreeSet<String>,
    /// Channels whose numbers suggest a different unit.
    pub suspicions: Vec<Suspicion>,
    /// Warnings about the map and its data, sorted.
    pub warnings: BTreeSet<ImportWarning>,
}

/// Summary of the frames of one view, or of the only picture of each row.
///
/// ```
/// # use taceva_import::{ImportMap, ImportPlan};
/// # let folder = tempfile::tempdir()?;
/// # image::GrayImage::from_pixel(8, 6, image::Luma([90])).save(folder.path().join("1.png"))?;
/// std::fs::write(folder.path().join("labels.csv"), "file\n1.png\n")?;
/// let map = "map_version = 2\ntable = \"labels.csv\"\n[frame]\ncolumn = \"file\"\nchannel_order = \"gray\"\nreference = \"unknown\"\n\
///     [time]\nclock = \"unknown\"\n[sensor]\nmodel = \"my gel\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = true\n";
/// let plan = ImportPlan::new(folder.path(), &ImportMap::parse("map.toml".as_ref(), map)?)?;
/// let frames = &plan.summary().frames[0];
/// assert_eq!((&frames.view, &frames.reference, frames.references), (&None, &None, 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct FrameSummary {
    /// Name of the view; `None` if each row has only one picture.
    pub view: Option<String>,
    /// Colour order in the files.
    pub channel_order: ChannelOrder,
    /// Frame without contact; `None` if unknown.
    pub reference: Option<PathBuf>,
    /// Number of different frames without contact, if they differ between rows; otherwise 0. These pictures are not copied. The attribute `reference`
    /// or `reference_VIEW` contains their names.
    pub references: u64,
}

/// Maximum number of unmentioned columns that a header names, and maximum length of a name, bytes.
const REMEMBERED: usize = 256;
const REMEMBERED_BYTES: usize = 256;

/// Numbers of matched, unmatched and excluded rows of a join.
///
/// ```
/// use taceva_import::JoinSummary;
///
/// let none = JoinSummary::default();
/// assert_eq!((none.matched, none.greatest_gap_s), (0, None));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct JoinSummary {
    /// Name of the join in the map.
    pub name: String,
    /// Number of rows of the main table with a match.
    pub matched: u64,
    /// Number of rows of the main table without a match.
    pub unmatched: u64,
    /// Number of rows of the joined table that no main row uses.
    pub unused: u64,
    /// Number of rows of the joined table excluded by `skip`.
    pub skipped: u64,
    /// Coordinate frame to which the map restricts the rows, if any.
    pub frame_id: Option<String>,
    /// Number of rows of the joined table in coordinate frames other than `frame_id`.
    pub in_other_frames: u64,
    /// Maximum time difference of a match, s; `None` unless the join is by time.
    pub greatest_gap_s: Option<f64>,
}

impl ImportSummary {
    /// Numbers of left-out items, in the form that the header of the dataset stores.
    pub(super) fn left_out(&self) -> LeftOut {
        let of_joins = |count: fn(&JoinSummary) -> u64| {
            let joins = self.joins.iter();
            let counts = joins.map(|join| (join.name.clone(), count(join)));
            counts.filter(|(_, count)| *count > 0).collect()
        };
        let columns = self.unmentioned_columns.len() - self.columns_left_behind().len();
        let mut left_out = LeftOut::default();
        left_out.images = self.unnamed_images;
        left_out.columns = columns as u64;
        left_out.rows = self.dropped.clone();
        left_out.joined_rows = of_joins(|join| join.unused);
        left_out.skipped_rows = of_joins(|join| join.skipped + join.in_other_frames);
        left_out.frames = self.unused_frames.clone();
        left_out.absent_chunks = self.absent_chunks.clone();
        left_out
    }

    /// Warnings and suspicions, as texts that the dataset stores.
    pub(super) fn warnings_in_words(&self) -> Vec<String> {
        let warnings = self.warnings.iter().map(ToString::to_string);
        let suspicions = self.suspicions.iter().map(ToString::to_string);
        warnings.chain(suspicions).collect()
    }

    /// Unmentioned columns that the dataset stores. Columns with quality ratings come first.
    pub(super) fn columns_left_behind(&self) -> Vec<String> {
        let short = |name: &&String| name.len() <= REMEMBERED_BYTES;
        let mut columns: Vec<String> = self
            .unmentioned_columns
            .iter()
            .filter(short)
            .cloned()
            .collect();
        columns.sort_by_key(|name| !names_quality(name));
        columns.truncate(REMEMBERED);
        columns
    }
}

/// Zero subtracted from one channel.
///
/// ```
/// # use taceva_import::{ImportMap, ImportPlan};
/// # let folder = tempfile::tempdir()?;
/// std::fs::write(folder.path().join("labels.csv"), "force\n0.5\n2.5\n")?;
/// let map = "map_version = 2\ntable = \"labels.csv\"\n[columns]\nFz = { from = \"force\", unit = \"N\" }\n[zero]\nfrom = \"first 1\"\n\
///     [time]\nclock = \"unknown\"\n[sensor]\nmodel = \"my gel\"\nserial = \"unknown\"\ngel = \"unknown\"\nopaque = true\n";
/// let plan = ImportPlan::new(folder.path(), &ImportMap::parse("map.toml".as_ref(), map)?)?;
/// let zero = &plan.summary().zeros[0];
/// assert_eq!((zero.channel.as_str(), zero.least, zero.blocks), ("Fz", 0.5, 1));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ZeroSummary {
    /// Name of the channel, such as `Fz`.
    pub channel: String,
    /// Rule of the map that selects the rows at zero force, in words.
    pub rule: String,
    /// Minimum of the means of all blocks, in the unit of the channel.
    pub least: f64,
    /// Maximum of the means of all blocks, in the unit of the channel.
    pub greatest: f64,
    /// Number of blocks, each with a separate zero.
    pub blocks: u64,
}

/// Computation of one channel: `sign · scale · (cell − offset)`, then converted to the stored unit.
///
/// ```
/// # use taceva_core::{Channel, Channels, Clock, SourceUnit};
/// # use taceva_dataset::{RecordingFacts, SensorFacts, Source};
/// # use taceva_import::{ColumnMap, ImportMap, ImportPlan};
/// # let folder = tempfile::tempdir()?;
/// std::fs::write(folder.path().join("labels.csv"), "force\n1500\n2000\n")?;
/// let facts = RecordingFacts::new(Source::Recorded, Clock::Unknown, SensorFacts::new("my gel"));
/// let mut map = ImportMap::new("labels.csv", facts);
/// map.channels = Channels::new([Channel::FZ])?;
/// map.columns = vec![ColumnMap::new("force", SourceUnit::parse("mN")?)];
/// let plan = ImportPlan::new(folder.path(), &map)?;
///
/// let conversion = &plan.summary().conversions[0];
/// assert_eq!((conversion.column.as_str(), conversion.channel.as_str()), ("force", "Fz"));
/// assert_eq!(conversion.present, 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Conversion {
    /// Name of the channel, such as `Fz`.
    pub channel: String,
    /// Source column as the map names it.
    pub column: String,
    /// Unit of the column.
    pub from: SourceUnit,
    /// Unit in the dataset.
    pub to: Unit,
    /// True if the sign is inverted.
    pub is_negated: bool,
    /// Offset subtracted from each cell first, in the unit of the cells.
    pub offset: Option<f64>,
    /// Factor applied after the offset; `None` for no factor.
    pub scale: Option<f64>,
    /// Number of samples with a value.
    pub present: u64,
}
