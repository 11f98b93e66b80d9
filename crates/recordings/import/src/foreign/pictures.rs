//! Pictures inside other files: in arrays, cells, clips, messages.

use std::fmt;
use std::path::Path;

use taceva_core::Frame;

use super::said;
use crate::error::ImportError;
use taceva_dataset::internal::guarded;
use taceva_dataset::{ChannelOrder, FrameCodec};

/// Pictures of a file, by number from 0.
pub(crate) trait Pictures: fmt::Debug + Send + Sync {
    /// File that contains the pictures.
    fn path(&self) -> &Path;

    /// Number of pictures.
    fn count(&self) -> u64;

    /// Calls `each` for the pictures with the numbers `sorted`, in this strictly ascending order.
    ///
    /// # Errors
    /// An error for a damaged picture, or an error of `each`.
    fn visit(
        &self,
        sorted: &[u64],
        order: ChannelOrder,
        each: Visit<'_>,
    ) -> Result<(), ImportError>;

    /// Codec of the frames of a clip; `None` for other files.
    fn codec(&self) -> Option<FrameCodec> {
        None
    }

    /// File that contains the picture at `index`, and the number of the picture in that file.
    fn origin(&self, index: u64) -> (&Path, u64) {
        (self.path(), index)
    }

    /// Files that contain the pictures, each with its number of pictures.
    fn files(&self) -> Vec<(&Path, u64)> {
        vec![(self.path(), self.count())]
    }

    /// Arrays with unwritten chunks, and the number of unwritten chunks of each.
    ///
    /// # Errors
    /// An error for a damaged list of chunks.
    fn absent_chunks(&self) -> Result<Vec<(String, u64)>, ImportError> {
        Ok(Vec::new())
    }

    /// Checks that a picture exists at `index`.
    fn check_index(&self, index: u64) -> Result<(), ImportError> {
        if index < self.count() {
            return Ok(());
        }
        Err(ImportError::image(
            self.path(),
            format!(
                "no frame {index}: there are {}, counted from 0",
                self.count()
            ),
        ))
    }
}

/// Callback that receives the number and the pixels or bytes of each picture.
pub(crate) type Visit<'v> = &'v mut dyn FnMut(u64, Picture) -> Result<(), ImportError>;

/// Reason why a visit ended early: the file is damaged, or the caller rejected a picture.
pub(super) enum Ended<E> {
    File(E),
    Picture(ImportError),
}

impl<E> From<E> for Ended<E> {
    fn from(error: E) -> Ended<E> {
        Ended::File(error)
    }
}

/// Runs a visit of the file at `path`. A panic of a decoder becomes an error of the file.
pub(super) fn guarded_visit<E: fmt::Display>(
    path: &Path,
    visit: impl FnOnce() -> Result<(), Ended<E>>,
) -> Result<(), ImportError> {
    match guarded(visit) {
        Ok(Ok(())) => Ok(()),
        Ok(Err(Ended::Picture(error))) => Err(error),
        Ok(Err(Ended::File(error))) => Err(ImportError::image(path, said(path, &error))),
        Err(problem) => Err(ImportError::image(path, problem)),
    }
}

/// Picture as found in a file.
pub(crate) enum Picture {
    /// Bytes of a PNG, JPEG or TIFF file, which are stored unchanged.
    Encoded(Vec<u8>),
    Pixels(Frame),
}

impl Picture {
    /// Size in memory, bytes.
    pub(crate) fn size(&self) -> usize {
        match self {
            Picture::Encoded(bytes) => bytes.len(),
            Picture::Pixels(frame) => frame.bytes().len(),
        }
    }
}
