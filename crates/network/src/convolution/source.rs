//! Input of the forward pass of a convolution.

use crate::planes::Planes;

/// Input of the forward pass of a convolution.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    /// Weights returned by [`Forward::weights`](super::Forward::weights).
    pub(crate) weights: &'a [f32],
    pub(crate) input: &'a Planes,
    /// Index of the first picture.
    pub(crate) first: usize,
    /// Number of pictures.
    pub(crate) count: usize,
}

impl<'a> Source<'a> {
    /// Values of the pictures, including borders.
    pub(super) fn pictures(&self) -> &'a [f32] {
        self.input.from(self.first, self.count)
    }
}
