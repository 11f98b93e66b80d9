//! Checks the files of a dataset against its header.

use std::io::{Seek, SeekFrom};
use std::path::Path;

use taceva_core::{counted, shown};

use super::Dataset;
use crate::digest::Digest;
use crate::error::DatasetError;
use crate::file::check_relative;
use crate::folder_handle::HeldFolder;
use crate::header::{Header, dataset_digest};
use crate::layout;
use crate::limits;
use crate::samples::from_parquet;
use crate::table::{FrameEntry, Table, is_attribute_name};
use crate::task::{Task, TaskKind};

impl Dataset {
    /// Reads all frames, depth maps, signals and predictions, and checks their digests. Does not decode frames.
    ///
    /// # Errors
    /// Errors of [`frame_bytes`](Dataset::frame_bytes), for the first file that differs from its digest.
    pub fn verify_frames(&self) -> Result<(), DatasetError> {
        if !self.joined.is_empty() {
            let mut joined = self.joined.iter();
            return joined.try_for_each(|joined| joined.dataset().verify_frames());
        }
        let entries = match self.header.views.is_empty() {
            true => {
                let frames = self.table.frames().iter().flatten().cloned();
                frames.chain(self.reference_entry()).collect()
            }
            false => self.entries_of_views(),
        };
        for entry in &entries {
            self.frame_bytes(entry)?;
        }
        self.verify_predictions()?;
        self.verify_maps()?;
        self.verify_signals()
    }

    /// Checks that the table of predictions beside the recording, if any, is unchanged.
    fn verify_predictions(&self) -> Result<(), DatasetError> {
        let Some(predictions) = &self.header.predictions else {
            return Ok(());
        };
        let path = &self.path().join(layout::PREDICTIONS);
        let (mut file, _) = self.folder.file(layout::PREDICTIONS, limits::TABLE_BYTES)?;
        let found = Digest::of_reader(&mut file).map_err(DatasetError::io("read", path))?;
        check_digest(path, predictions.sha256, found)
    }

    /// Checks that header and table agree and that all paths are valid. Later reads of frames need no further check.
    ///
    /// The digest that the header file states does not cover tasks. This check therefore runs before the tasks are added to the digest in memory.
    pub(super) fn check_consistency(&self) -> Result<(), DatasetError> {
        let damaged =
            |name: &str, problem: String| DatasetError::damaged(&self.path().join(name), problem);
        let rows = self.table.rows() as u64;
        if rows != self.header.table.rows {
            let promised = self.header.table.rows;
            return Err(damaged(
                layout::SAMPLES,
                format!("{}, expected {promised}", counted(rows, "row")),
            ));
        }
        let digest = self.table.digest();
        if digest != self.header.table.digest {
            return Err(DatasetError::digest(
                &self.path().join(layout::SAMPLES),
                self.header.table.digest,
                digest,
            ));
        }
        let digest = dataset_digest(
            digest,
            self.header.frames.as_ref(),
            &self.header.views,
            self.header.signals.as_ref(),
            &self.header.extended,
        );
        if digest != self.header.digest {
            return Err(DatasetError::digest(
                &self.path().join(layout::HEADER),
                self.header.digest,
                digest,
            ));
        }
        let count = self.table.frames().iter().flatten().count() as u64;
        let promised = self.header.frames.as_ref().map_or(0, |frames| frames.count);
        if count != promised {
            return Err(damaged(
                layout::SAMPLES,
                format!("{}, expected {promised}", counted(count, "frame")),
            ));
        }
        for (view, own) in self.header.views.iter().zip(self.table.views()) {
            let count = own.frames().iter().flatten().count() as u64;
            if count != view.frames.count {
                return Err(damaged(
                    layout::SAMPLES,
                    format!(
                        "{} of the view `{}`, expected {}",
                        counted(count, "frame"),
                        view.name,
                        view.frames.count
                    ),
                ));
            }
        }
        // The name of a task of depth maps is also the name of its file, here and in an export.
        let mut tasks = self.header.tasks.iter();
        let is_path = |task: &&Task| task.kind == TaskKind::Depth && !is_attribute_name(&task.name);
        if let Some(task) = tasks.find(is_path) {
            return Err(damaged(
                layout::HEADER,
                format!(
                    "the name `{}` of a task of depth maps is reserved or invalid: expected a letter, then letters, digits or `_`",
                    shown(&task.name)
                ),
            ));
        }
        let own = self.table.frames().iter().flatten().cloned();
        let own = own.chain(self.reference_entry());
        for FrameEntry { path, .. } in own.chain(self.entries_of_views()) {
            check_relative(&path).map_err(|problem| DatasetError::path(&path, problem))?;
        }
        Ok(())
    }
}

pub(super) fn read_table(folder: &HeldFolder, header: &Header) -> Result<Table, DatasetError> {
    let path = &folder.path().join(layout::SAMPLES);
    let (mut file, _) = folder.file(layout::SAMPLES, limits::TABLE_BYTES)?;
    let found = Digest::of_reader(&mut file).map_err(DatasetError::io("read", path))?;
    check_digest(path, header.table.sha256, found)?;
    file.seek(SeekFrom::Start(0))
        .map_err(DatasetError::io("read", path))?;
    let views: Vec<&str> = header.views.iter().map(|view| view.name.as_str()).collect();
    let read = from_parquet(
        file,
        &header.channels,
        &header.attributes,
        &views,
        &header.tasks,
    );
    read.map_err(|problem| DatasetError::damaged(path, problem))
}

pub(super) fn check_digest(
    path: &Path,
    expected: Digest,
    found: Digest,
) -> Result<(), DatasetError> {
    if expected == found {
        return Ok(());
    }
    Err(DatasetError::digest(path, expected, found))
}
