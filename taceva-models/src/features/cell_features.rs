//! Interface of feature kinds: some values per cell.

use std::fmt;

use taceva_core::Frame;

/// One kind of features, for frames of one size and format.
pub(super) trait CellFeatures: fmt::Debug + Send + Sync {
    /// Values per cell.
    fn depth(&self) -> usize;

    /// Writes the values of every cell of `frame`. The caller has checked its size and format.
    ///
    /// # Shapes
    /// `into`: `[height, width, depth]`, completely overwritten.
    fn write(&self, frame: &Frame, into: &mut [f32]);
}
