//! Frames of a dataset: read, verified and decoded on request.

use std::sync::{Arc, PoisonError};

use taceva_core::Frame;

use super::Dataset;
use super::verify::check_digest;
use super::views::reference_entry;
use crate::decode::{check_to_the_end, decode, kind_of_whole};
use crate::difference;
use crate::digest::Digest;
use crate::error::DatasetError;
use crate::header::FramesInfo;
use crate::limits;
use crate::pack::read_span;
use crate::table::FrameEntry;

impl Dataset {
    /// Frame of a row, verified and decoded; `None` if the row has no frame.
    ///
    /// # Errors
    /// [`DatasetError::Digest`] if the file of the frame differs from the recorded digest; [`DatasetError::Image`] if the frame cannot be decoded;
    /// [`DatasetError::Request`] if the row does not exist; [`DatasetError::View`] if rows have several pictures and no view is selected; [`DatasetError::Io`].
    pub fn frame(&self, row: usize) -> Result<Option<Frame>, DatasetError> {
        self.check_row(row)?;
        if let Some((recording, row)) = self.recording_of(row) {
            return recording.frame(row);
        }
        self.require_view()?;
        if self.seen.len() > 1 {
            return self.frame_beside(row);
        }
        match (&self.table.frames()[row], &self.header.frames) {
            (Some(entry), Some(info)) => self.read_frame(entry, info).map(Some),
            _ => Ok(None),
        }
    }

    /// Description of damage inside the picture of a row that decodes without an error. `None` if the picture is intact or missing.
    ///
    /// A JPEG is checked code by code to its end. Imports reject this damage, but older datasets may contain it.
    ///
    /// # Errors
    /// [`DatasetError::Digest`] if the file of the picture differs from the recorded digest; [`DatasetError::Request`] if the row does not exist;
    /// [`DatasetError::Io`].
    pub fn damage_inside(&self, row: usize) -> Result<Option<String>, DatasetError> {
        self.check_row(row)?;
        if let Some((recording, row)) = self.recording_of(row) {
            return recording.damage_inside(row);
        }
        let beside = self.seen.iter().filter(|_| self.seen.len() > 1);
        let beside = beside.filter_map(|at| self.table.views()[*at].frames()[row].as_ref());
        let own = self.table.frames()[row].iter();
        let own = own.filter(|_| self.seen.len() < 2);
        for entry in own.chain(beside) {
            let bytes = self.frame_bytes(entry)?;
            let whole = kind_of_whole(&bytes).and_then(|kind| check_to_the_end(&bytes, kind));
            if let Err(problem) = whole {
                return Ok(Some(problem));
            }
        }
        Ok(None)
    }

    /// Frame without contact; `None` if unknown, and for joined recordings, because each recording has a separate frame without contact.
    ///
    /// # Errors
    /// Errors of [`frame`](Dataset::frame).
    pub fn reference(&self) -> Result<Option<Frame>, DatasetError> {
        let Some(info) = &self.header.frames else {
            return Ok(None);
        };
        if self.joined.is_empty() && self.seen.len() > 1 {
            return self.reference_beside();
        }
        let entry = self.reference_entry();
        let frame = entry.map(|entry| self.read_frame(&entry, info));
        frame.transpose()
    }

    /// Original bytes of the picture without contact, verified; `None` if unknown, and for views side by side.
    pub fn reference_bytes(&self) -> Result<Option<Vec<u8>>, DatasetError> {
        let entry = self.reference_entry();
        entry.map(|entry| self.frame_bytes(&entry)).transpose()
    }

    pub(super) fn read_frame(
        &self,
        entry: &FrameEntry,
        info: &FramesInfo,
    ) -> Result<Frame, DatasetError> {
        let path = self.path().join(&entry.path);
        let bytes = self.frame_bytes(entry)?;
        let first = match entry.is_difference() {
            true => Some(self.first_of_pack(entry, info)?),
            false => None,
        };
        let wrong = |problem| DatasetError::image(&path, problem);
        let (_, mut frame) = decode(&bytes, info.channel_order).map_err(wrong)?;
        if let Some(first) = first.filter(|first| first.info() == frame.info()) {
            frame = difference::plus(&frame, &first).map_err(|error| wrong(error.to_string()))?;
        }
        if frame.info() != info.info {
            return Err(wrong(format!(
                "{}, expected {} as in the header",
                frame.info(),
                info.info
            )));
        }
        Ok(frame)
    }

    /// Original bytes of a frame, verified.
    ///
    /// # Errors
    /// [`DatasetError::Digest`] if the bytes differ from the recorded digest; [`DatasetError::Io`].
    pub fn frame_bytes(&self, entry: &FrameEntry) -> Result<Vec<u8>, DatasetError> {
        if let Some((recording, entry)) = self.entry_of(entry) {
            return recording.frame_bytes(&entry);
        }
        let path = self.path().join(&entry.path);
        let bytes = match entry.span {
            Some(span) => {
                let (file, _) = self.folder.file(&entry.path, u64::MAX)?;
                read_span(file, &path, span)?
            }
            None => self.folder.read(&entry.path, limits::IMAGE_BYTES)?,
        };
        let found = match entry.is_difference() {
            true => difference::digest(self.first_entry(entry)?.digest, &bytes),
            false => Digest::of(&bytes),
        };
        check_digest(&path, entry.digest, found)?;
        Ok(bytes)
    }

    /// First frame of the pack that contains `entry`. The other frames of this pack are stored as differences from the first frame.
    fn first_entry(&self, entry: &FrameEntry) -> Result<&FrameEntry, DatasetError> {
        let is_first = |first: &&FrameEntry| first.begins(&entry.path) && !first.is_difference();
        let mut frames = self.table.frames().iter().flatten();
        frames.find(is_first).ok_or_else(|| {
            DatasetError::damaged(
                &self.path().join(&entry.path),
                "no row names the first frame of this pack, which all other frames of the pack need",
            )
        })
    }

    /// First frame of the pack of `entry`, decoded once per pack.
    fn first_of_pack(
        &self,
        entry: &FrameEntry,
        info: &FramesInfo,
    ) -> Result<Arc<Frame>, DatasetError> {
        let lock = || self.firsts.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(first) = lock().get(&entry.path) {
            return Ok(Arc::clone(first));
        }
        let first = Arc::new(self.read_frame(self.first_entry(entry)?, info)?);
        lock().insert(entry.path.clone(), Arc::clone(&first));
        Ok(first)
    }

    pub(super) fn reference_entry(&self) -> Option<FrameEntry> {
        // Views side by side have no single file.
        if !self.joined.is_empty() || self.seen.len() > 1 {
            return None;
        }
        let reference = self.header.frames.as_ref()?.reference.as_ref()?;
        Some(reference_entry(reference))
    }

    pub(super) fn check_row(&self, row: usize) -> Result<(), DatasetError> {
        if row < self.table.rows() {
            return Ok(());
        }
        Err(DatasetError::request(
            self.path(),
            format!("no row {row}, expected below {}", self.table.rows()),
        ))
    }
}
