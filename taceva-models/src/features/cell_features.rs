//! What every kind of features gives: some numbers a cell.

use std::fmt;

use taceva_core::Frame;

/// One kind of features of frames of one size and format.
pub(super) trait CellFeatures: fmt::Debug + Send + Sync {
    /// Numbers a cell.
    fn depth(&self) -> usize;

    /// Writes the numbers of every cell of `frame`, whose size and format the caller has checked.
    ///
    /// # Shapes
    /// `into`: `[height, width, depth]`, every number of it written.
    fn write(&self, frame: &Frame, into: &mut [f32]);
}
