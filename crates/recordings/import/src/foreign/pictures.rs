//! Pictures that are no files of their own: in arrays, in cells, in clips, in messages.

use std::fmt;
use std::path::Path;

use taceva_core::Frame;

use super::said;
use taceva_dataset::internal::guarded;
use taceva_dataset::{ChannelOrder, DatasetError, FrameCodec};

/// Pictures by their number, from 0.
pub(crate) trait Pictures: fmt::Debug + Send + Sync {
    /// The file that they are in.
    fn path(&self) -> &Path;

    /// How many there are.
    fn count(&self) -> u64;

    /// Hands over the pictures of `sorted`, ascending and each once, in that order.
    ///
    /// # Errors
    /// What is wrong with one of them, and whatever `each` returns.
    fn visit(
        &self,
        sorted: &[u64],
        order: ChannelOrder,
        each: Visit<'_>,
    ) -> Result<(), DatasetError>;

    /// How they were coded, where they are frames of a clip.
    fn codec(&self) -> Option<FrameCodec> {
        None
    }

    /// The file that the picture at `index` is in, and its number there.
    fn origin(&self, index: u64) -> (&Path, u64) {
        (self.path(), index)
    }

    /// The files that they are in, each with how many are in it.
    fn files(&self) -> Vec<(&Path, u64)> {
        vec![(self.path(), self.count())]
    }

    /// The arrays that they lie in of which chunks were never written, and how many.
    ///
    /// # Errors
    /// What is wrong with the list of chunks.
    fn absent_chunks(&self) -> Result<Vec<(String, u64)>, DatasetError> {
        Ok(Vec::new())
    }

    /// Whether there is a picture at `index`.
    fn check_index(&self, index: u64) -> Result<(), DatasetError> {
        if index < self.count() {
            return Ok(());
        }
        Err(DatasetError::Image {
            place: None,
            path: self.path().to_owned(),
            problem: format!("no frame {index}, there are {} from 0", self.count()),
        })
    }
}

/// What is done with each picture.
pub(crate) type Visit<'v> = &'v mut dyn FnMut(u64, Picture) -> Result<(), DatasetError>;

/// Why a visit ended early: the file is wrong, or the caller refused a picture.
pub(super) enum Ended<E> {
    File(E),
    Picture(DatasetError),
}

impl<E> From<E> for Ended<E> {
    fn from(error: E) -> Ended<E> {
        Ended::File(error)
    }
}

/// Runs a visit of the file at `path`; a panic of its decoder is an error of the file.
pub(super) fn guarded_visit<E: fmt::Display>(
    path: &Path,
    visit: impl FnOnce() -> Result<(), Ended<E>>,
) -> Result<(), DatasetError> {
    match guarded(visit) {
        Ok(Ok(())) => Ok(()),
        Ok(Err(Ended::Picture(error))) => Err(error),
        Ok(Err(Ended::File(error))) => Err(damaged(path, said(path, &error))),
        Err(problem) => Err(damaged(path, problem)),
    }
}

/// What is wrong with pictures in the file at `path`.
pub(super) fn damaged(path: &Path, problem: String) -> DatasetError {
    DatasetError::Image {
        place: None,
        path: path.to_owned(),
        problem,
    }
}

/// A picture as it was found.
pub(crate) enum Picture {
    /// The bytes of a PNG, JPEG or TIFF file, which are kept.
    Encoded(Vec<u8>),
    Pixels(Frame),
}

impl Picture {
    /// What it takes in memory, bytes.
    pub(crate) fn size(&self) -> usize {
        match self {
            Picture::Encoded(bytes) => bytes.len(),
            Picture::Pixels(frame) => frame.bytes().len(),
        }
    }
}
