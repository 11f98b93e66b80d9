//! Where the frames of a recording come from.

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

/// The frames of a recording, wherever they lie: a folder here, a dataset elsewhere.
pub trait FrameSource: Send {
    /// Size and format of every frame.
    fn info(&self) -> FrameInfo;

    /// When each frame was true.
    ///
    /// # Shapes
    /// A time a frame, at least one; finite and strictly increasing.
    /// # Units
    /// s, of the clock of the recording.
    fn times_s(&self) -> &[f64];

    /// Writes the frame at `position` into the caller's buffer.
    ///
    /// # Errors
    /// [`SourceError`] if the frame is gone, damaged, or unlike the others; the other frames can still be read.
    /// # Panics
    /// If there is no such frame, or `into` is no [`info`](FrameSource::info): mistakes of the caller's code.
    fn read(&mut self, position: usize, into: FrameMut<'_>) -> Result<(), SourceError>;
}
