//! Interface of the kinds of features. Each kind computes a fixed number of values per cell of a frame.

use std::fmt;

use taceva_core::Frame;

/// One kind of features, prepared for frames of one size and format.
pub(super) trait CellFeatures: fmt::Debug + Send + Sync {
    /// Number of values per cell.
    fn depth(&self) -> usize;

    /// Writes the values of every cell of `frame` to `into`. The caller must check the size and format of the frame.
    ///
    /// # Shapes
    /// `into`: `[height, width, depth]`, completely overwritten.
    fn write(&self, frame: &Frame, into: &mut [f32]);
}
