//! What an import reads, keeps, converts and leaves out.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use taceva_core::{SignalInfo, SourceUnit, Unit};

use super::suspicion::Suspicion;
use super::warning::ImportWarning;
use taceva_dataset::{ChannelOrder, LeftOut, names_quality};

/// The counts of an import.
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
    /// The main tables, in the order in which their rows are read.
    pub tables: Vec<PathBuf>,
    /// How many files are rows of their own, where there is no table; else 0.
    pub files: u64,
    /// How many rows the main tables have.
    pub rows_read: u64,
    /// How many of them become samples of the dataset.
    pub rows_kept: u64,
    /// Rows left out by each rule; a row may be left out by several.
    pub dropped: BTreeMap<String, u64>,
    /// How the rows of joined tables were matched, a join each.
    pub joins: Vec<JoinSummary>,
    /// How each channel is computed from its column, and how many values it has.
    pub conversions: Vec<Conversion>,
    /// The zero that is subtracted from each force, where the map says one.
    pub zeros: Vec<ZeroSummary>,
    /// The weight that is subtracted from forces and torques, in words.
    pub gravity: Option<String>,
    /// The grid and the unit of the signals; `None` without such.
    pub signals: Option<SignalInfo>,
    /// The frames of each view; none without frames.
    pub frames: Vec<FrameSummary>,
    /// Images beside the table that no row names.
    pub unnamed_images: u64,
    /// The first 20 of these images, sorted.
    pub first_unnamed_images: Vec<PathBuf>,
    /// Whether there may be more such images: only the first files below the folder were looked at.
    pub has_more_files: bool,
    /// Frames in arrays and clips that no row uses, by file.
    pub unused_frames: BTreeMap<String, u64>,
    /// Chunks of arrays that were never written, by file and array: what is read instead is their fill value.
    pub absent_chunks: BTreeMap<String, u64>,
    /// Columns of the tables that the map does not mention, sorted.
    pub unmentioned_columns: BTreeSet<String>,
    /// Topics of recordings that are not read, each with the reason.
    pub unread_topics: BTreeSet<String>,
    /// Channels whose numbers look like those of another unit.
    pub suspicions: Vec<Suspicion>,
    /// Warnings about the map and what it reads, sorted.
    pub warnings: BTreeSet<ImportWarning>,
}

/// The frames of one view, or those of rows that have one picture.
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
    /// The view; `None` where rows have one picture.
    pub view: Option<String>,
    /// Order of the colours in the files.
    pub channel_order: ChannelOrder,
    /// The frame without contact; `None` if none is known.
    pub reference: Option<PathBuf>,
    /// Number of different frames without contact that rows name, where these differ. Their pictures are not copied: the attribute `reference`, of
    /// a view `reference_VIEW`, names them.
    pub references: u64,
}

/// How many columns that the map does not mention a dataset remembers, and how long their names may be.
const REMEMBERED: usize = 256;
const REMEMBERED_BYTES: usize = 256;

/// How the rows of another table were matched.
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
    /// The name of the join in the map.
    pub name: String,
    /// Rows of the main table to which one belongs.
    pub matched: u64,
    /// Rows of the main table to which none belongs.
    pub unmatched: u64,
    /// Rows of the other table that belong to none.
    pub unused: u64,
    /// Rows of the other table that `skip` says are no candidates.
    pub skipped: u64,
    /// The coordinate frame whose rows the map takes, where it names one.
    pub frame_id: Option<String>,
    /// Rows of the other table that are given in other frames than `frame_id`.
    pub in_other_frames: u64,
    /// The greatest distance in time of what was matched, s; `None` of a join by anything else.
    pub greatest_gap_s: Option<f64>,
}

impl ImportSummary {
    /// What the dataset remembers of what is left out.
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

    /// The warnings as the dataset keeps them.
    pub(super) fn warnings_in_words(&self) -> Vec<String> {
        let warnings = self.warnings.iter().map(ToString::to_string);
        let suspicions = self.suspicions.iter().map(ToString::to_string);
        warnings.chain(suspicions).collect()
    }

    /// The columns that the map does not mention, as the dataset remembers them: those that rate their rows first.
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

/// The zero that is subtracted from one channel.
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
    /// The channel.
    pub channel: String,
    /// The rule of the map in words.
    pub rule: String,
    /// The least mean of a block, in the unit of the channel.
    pub least: f64,
    /// The greatest mean of a block, in the unit of the channel.
    pub greatest: f64,
    /// Number of blocks, each with a zero of its own.
    pub blocks: u64,
}

/// How one channel is computed: unit(sign · scale · (cell − offset)).
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
    /// The name of the channel, such as `Fz`.
    pub channel: String,
    /// The column that it comes from, as the map names it.
    pub column: String,
    /// The unit of the numbers in the column.
    pub from: SourceUnit,
    /// The unit that the dataset keeps them in.
    pub to: Unit,
    /// Whether its sign is inverted.
    pub is_negated: bool,
    /// What is subtracted from each cell first, in the unit of the cells.
    pub offset: Option<f64>,
    /// What the difference is then multiplied by.
    pub scale: Option<f64>,
    /// How many samples have a value of it.
    pub present: u64,
}
