//! Sources of recorded frames.

mod decode;
mod error;
mod folder;
mod limits;
mod times;

#[cfg(feature = "camera")]
pub(crate) use decode::{Mismatch, decode, info as frame_info};
pub use error::SourceError;
pub use folder::{FolderSource, Timing};

use taceva_core::{FrameInfo, FrameMut};

/// Source of the frames of a recording: a folder in this crate, a dataset in other crates.
pub trait FrameSource: Send {
    /// Size and format of every frame.
    fn info(&self) -> FrameInfo;

    /// Time of each frame.
    ///
    /// # Shapes
    /// One time per frame, at least one; finite and strictly increasing.
    /// # Units
    /// s, on the clock of the recording.
    fn times_s(&self) -> &[f64];

    /// Writes the frame at `position` into the caller's buffer.
    ///
    /// # Errors
    /// [`SourceError`] if the frame is missing or damaged, or its size or format differs from [`info`](FrameSource::info).
    /// Other frames remain readable.
    /// # Panics
    /// If `position` is out of range, or `into` does not match [`info`](FrameSource::info): bugs of the caller.
    fn read(&mut self, position: usize, into: FrameMut<'_>) -> Result<(), SourceError>;
}
