//! Running an import: every frame is read, verified and copied, and the dataset appears whole.

mod frames;
mod picture;

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::{FrameInfo, Progress};

use super::plan::ImportPlan;
use super::summary::ImportSummary;
use crate::source_sums::list_of;
pub(super) use frames::{CopiedFrames, copy_frames};
use taceva_dataset::internal::{
    Beside, layout, staging::Place, staging::StagedFolder, write_durable, write_table_and_header,
};
use taceva_dataset::{DatasetError, Digest, SourcesInfo, ViewInfo};

/// What an import did.
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
/// let target = folder.path().join("dataset");
/// let report = plan.run(&target, std::num::NonZeroUsize::MIN, &taceva_core::SilentProgress)?;
/// assert_eq!(report.digest, taceva_dataset::Dataset::open(&target)?.digest());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ImportReport {
    /// What was read, kept and left out.
    pub summary: ImportSummary,
    /// Size and format of the frames; `None` if there is none.
    pub frames: Option<FrameInfo>,
    /// Frames of each view, where samples have several pictures; then `frames` is `None`.
    pub views: Vec<ViewInfo>,
    /// The digest of the dataset.
    pub digest: Digest,
    /// The folder of the dataset.
    pub path: PathBuf,
}

impl ImportPlan {
    /// Writes the dataset to `target`, on `jobs` threads. The bytes are the same for any number of threads.
    ///
    /// Frames are kept as the bytes they came as; what came as numbers, of an array or a clip, becomes PNG. A JPEG is read to its end, so that what was cut, lost or
    /// changed in it is noticed unless every code is still one of its tables and the last one still ends where it did: a bit that was
    /// flipped before the import may change the picture without any error. Damage after the import is always noticed, by the digests.
    ///
    /// # Errors
    /// [`DatasetError::Image`] naming the image and the row if a frame does not decode or is unlike the first;
    /// [`DatasetError::TargetExists`], [`DatasetError::Busy`], [`DatasetError::Cancelled`], [`DatasetError::Io`]. After any of
    /// them `target` is absent.
    pub fn run(
        self,
        target: &Path,
        jobs: NonZeroUsize,
        progress: &dyn Progress,
    ) -> Result<ImportReport, DatasetError> {
        self.run_at(target, Place::Free, jobs, progress)
    }

    /// As [`run`](ImportPlan::run), in the place of the dataset at `target` if there is one: a reader sees the old one until
    /// the new one is whole and durable.
    ///
    /// # Errors
    /// As [`run`](ImportPlan::run), after which `target` is what it was; [`DatasetError::Request`] if it is no dataset, or holds what is no
    /// part of one.
    pub fn replace(
        self,
        target: &Path,
        jobs: NonZeroUsize,
        progress: &dyn Progress,
    ) -> Result<ImportReport, DatasetError> {
        self.run_at(target, Place::OfDataset, jobs, progress)
    }

    fn run_at(
        self,
        target: &Path,
        place: Place,
        jobs: NonZeroUsize,
        progress: &dyn Progress,
    ) -> Result<ImportReport, DatasetError> {
        let staged = StagedFolder::create(target, place)?;
        let mut table = self.table;
        let CopiedFrames {
            frames,
            views,
            folders,
        } = copy_frames(&staged, &self.frames, 0, &mut table, jobs, progress)?;
        let signals = self.signals.as_ref().map(|signals| {
            let path = staged.path().join(layout::SIGNALS);
            signals.write(&path, progress)
        });
        let info = frames.as_ref().map(|frames| frames.info);
        let sources = list_of(&self.folder, jobs, progress)?;
        write_durable(&staged.path().join(layout::SOURCES), sources.as_bytes())?;
        let header = write_table_and_header(
            &staged.path().join(layout::SAMPLES),
            &staged.path().join(layout::HEADER),
            &self.facts,
            &table,
            frames,
            Beside {
                unmentioned_columns: self.summary.columns_left_behind(),
                mapping: self.mapping,
                left_out: self.summary.left_out(),
                warnings: self.summary.warnings_in_words(),
                signals: signals.transpose()?,
                views,
                sources: Some(SourcesInfo::of(&sources)),
                ..Beside::default()
            },
        )?;
        staged.put_in_place(&folders)?;
        Ok(ImportReport {
            summary: self.summary,
            frames: info,
            views: header.views,
            digest: header.digest,
            path: target.to_owned(),
        })
    }
}
