//! Pictures that are no files of their own: in arrays, in cells, in clips, in messages.

use std::fmt;
use std::path::Path;

use taceva_core::Frame;

use crate::decode::ChannelOrder;
use crate::error::DatasetError;

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

/// A picture as it was found.
pub(crate) enum Picture {
    /// The bytes of a PNG or JPEG file, which are kept.
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
