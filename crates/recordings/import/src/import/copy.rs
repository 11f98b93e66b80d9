//! Runs an import: reads, verifies and copies every frame, and publishes the dataset atomically.

mod frames;
mod picture;

use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use taceva_core::{FrameInfo, Progress};

use super::depth_maps::write_maps;
use super::plan::ImportPlan;
use super::summary::ImportSummary;
use crate::error::ImportError;
use crate::source_sums::list_of;
pub(super) use frames::{CopiedFrames, copy_frames};
use taceva_dataset::internal::{
    Beside, layout, staging::Place, staging::StagedFolder, write_durable, write_table_and_header,
};
use taceva_dataset::{Digest, SourcesInfo, ViewInfo};

/// Result of an import.
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
    /// Numbers of items read, kept and left out.
    pub summary: ImportSummary,
    /// Size and format of the frames; `None` without frames.
    pub frames: Option<FrameInfo>,
    /// Frames of each view, if samples have several pictures; `frames` is then `None`.
    pub views: Vec<ViewInfo>,
    /// Digest of the dataset.
    pub digest: Digest,
    /// Folder of the dataset.
    pub path: PathBuf,
}

impl ImportPlan {
    /// Writes the dataset to `target` on `jobs` threads. The bytes are the same for any number of threads.
    ///
    /// Encoded frames keep their bytes; pixels from an array or a clip become PNG. A JPEG is decoded to its end. This check detects missing or changed
    /// data, unless every code is still valid and the last code ends at the same place. A bit changed before the import may therefore change the
    /// picture without an error. The digests detect all damage after the import.
    ///
    /// # Errors
    /// [`ImportError::Named`] naming the image and the row if a frame does not decode or differs in size or format from the first; [`ImportError::Dataset`]
    /// with `TargetExists`, `Busy`, `Cancelled` or `Io`. After an error `target` does not exist.
    pub fn run(
        self,
        target: &Path,
        jobs: NonZeroUsize,
        progress: &dyn Progress,
    ) -> Result<ImportReport, ImportError> {
        self.run_at(target, Place::Free, jobs, progress)
    }

    /// Writes the dataset like [`run`](ImportPlan::run), but replaces an existing dataset at `target`. Readers see the old dataset until the new one is
    /// complete and durable.
    ///
    /// # Errors
    /// Errors of [`run`](ImportPlan::run); `target` is unchanged after an error. [`ImportError::Dataset`] if `target` is not a dataset, or contains
    /// files that do not belong to a dataset.
    pub fn replace(
        self,
        target: &Path,
        jobs: NonZeroUsize,
        progress: &dyn Progress,
    ) -> Result<ImportReport, ImportError> {
        self.run_at(target, Place::OfDataset, jobs, progress)
    }

    fn run_at(
        self,
        target: &Path,
        place: Place,
        jobs: NonZeroUsize,
        progress: &dyn Progress,
    ) -> Result<ImportReport, ImportError> {
        let staged = StagedFolder::create(target, place)?;
        let mut table = self.table;
        let CopiedFrames {
            frames,
            views,
            mut folders,
        } = copy_frames(&staged, &self.frames, 0, &mut table, jobs, progress)?;
        folders.extend(write_maps(&self.maps, &staged, None, &mut table, progress)?);
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
