//! Plans an import: reads and converts everything before any writing.

mod channels;
mod completion;
mod drop_rules;
mod name_order;
mod pictures;
mod reading;
mod row_frames;
mod tasks;
mod view;

use std::collections::BTreeSet;
use std::path::Path;

use taceva_video::Decoders;

use super::depth_maps::PlannedMaps;
use super::frame_plan::{FrameSource, PlannedFrames};
use super::map::ImportMap;
use super::signals::{FoundSignals, PlannedSignals};
use super::source::matching_files;
use super::summary::ImportSummary;
use crate::error::ImportError;
use crate::foreign::TableForm;
use crate::source_folder::SourceFolder;
use reading::Reading;
use taceva_dataset::internal::Mapping;
use taceva_dataset::{RecordingFacts, Table};

/// Import with all labels read and converted, and all frames found. [`run`](ImportPlan::run) verifies the frames.
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
/// assert_eq!(plan.summary().rows_kept, 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct ImportPlan {
    pub(super) summary: ImportSummary,
    pub(super) facts: RecordingFacts,
    pub(super) table: Table,
    /// Pictures of each view.
    pub(super) frames: Vec<PlannedFrames>,
    pub(super) signals: Option<PlannedSignals>,
    /// Depth maps of each task with depth maps.
    pub(super) maps: Vec<PlannedMaps>,
    /// Summary of the map for the header.
    pub(super) mapping: Mapping,
    /// True if row numbers are the sample names, because the map names no column for them.
    pub(super) is_numbered: bool,
    /// Source folder, which records the files that were read.
    pub(super) folder: SourceFolder,
}

impl ImportPlan {
    /// Reads the tables that `map` names in the folder `source`, and finds every frame.
    ///
    /// # Errors
    /// [`ImportError::Table`] naming line and column; [`ImportError::Named`] or [`ImportError::Dataset`] if a path is missing, leads out of the folder or is
    /// not a regular file, or an array cannot be used.
    pub fn new(source: &Path, map: &ImportMap) -> Result<ImportPlan, ImportError> {
        ImportPlan::with_decoders(source, map, &Decoders::default())
    }

    /// Plans an import like [`new`](ImportPlan::new), with external programs for clips that TacEva cannot decode.
    ///
    /// # Errors
    /// Errors of [`new`](ImportPlan::new); [`ImportError::Dataset`] naming the codec and a remedy if no decoder for a clip is available.
    /// ```
    /// # use taceva_core::{Channel, Channels, Clock, SourceUnit};
    /// # use taceva_dataset::{RecordingFacts, SensorFacts, Source};
    /// # use taceva_import::{ColumnMap, ImportMap, ImportPlan};
    /// # let folder = tempfile::tempdir()?;
    /// # std::fs::write(folder.path().join("labels.csv"), "force\n1500\n2000\n")?;
    /// # let facts = RecordingFacts::new(Source::Recorded, Clock::Unknown, SensorFacts::new("my gel"));
    /// # let mut map = ImportMap::new("labels.csv", facts);
    /// # map.channels = Channels::new([Channel::FZ])?;
    /// # map.columns = vec![ColumnMap::new("force", SourceUnit::parse("mN")?)];
    /// use taceva_import::Decoders;
    ///
    /// let mut decoders = Decoders::default();
    /// decoders.ffmpeg = Some("/usr/bin/ffmpeg".into());
    /// let plan = ImportPlan::with_decoders(folder.path(), &map, &decoders)?;
    /// assert_eq!(plan.summary().rows_kept, 2);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_decoders(
        source: &Path,
        map: &ImportMap,
        decoders: &Decoders,
    ) -> Result<ImportPlan, ImportError> {
        let folder = SourceFolder::open(source)?;
        let tables = matching_files(&folder, &map.table)?;
        drop_rules::check_tables(&folder, map, &tables)?;
        let mut reading = Reading::new(&folder, map, decoders);
        reading.count = tables.len();
        let signals = map.signals.as_ref();
        let signals = signals.map(|signals| FoundSignals::new(signals, &folder));
        reading.signals = signals.transpose()?;
        reading.maps = PlannedMaps::of_tasks(map, &folder)?;
        for path in &tables {
            reading.read(path)?;
        }
        match map.form {
            TableForm::Files => reading.summary.files = tables.len() as u64,
            _ => reading.summary.tables = tables,
        }
        if reading.summary.rows_kept == 0 {
            return Err(reading.no_row());
        }
        let points = reading.table.point_id().iter().flatten();
        let points: BTreeSet<&String> = points.collect();
        reading.summary.points = points.len() as u64;
        reading.into_plan()
    }

    /// Numbers of items that the import reads, converts, keeps and leaves out.
    pub fn summary(&self) -> &ImportSummary {
        &self.summary
    }

    /// Total size of the image files, bytes. Each file is counted once; pictures inside other files are not counted.
    ///
    /// A deleted file counts as 0. The import itself reports the error.
    pub fn frame_bytes(&self) -> u64 {
        let frames = self.frames.iter();
        let files: BTreeSet<&Path> = frames
            .clone()
            .flat_map(|frames| frames.of_rows.iter())
            .filter_map(|frame| match &frame.from {
                FrameSource::File(path) => Some(path.as_path()),
                FrameSource::Within(..) => None,
            })
            .chain(
                frames.filter_map(|frames| match frames.reference.as_ref()? {
                    FrameSource::File(path) => Some(path.as_path()),
                    FrameSource::Within(..) => None,
                }),
            )
            .collect();
        let sizes = files.into_iter().filter_map(|path| path.metadata().ok());
        sizes.map(|facts| facts.len()).sum()
    }
}
