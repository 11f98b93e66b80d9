//! What a forward pass reads.

use crate::planes::Planes;

/// What a forward pass reads.
#[derive(Clone, Copy)]
pub(crate) struct Source<'a> {
    /// As [`Forward::weights`](super::Forward::weights) gives them.
    pub(crate) weights: &'a [f32],
    pub(crate) input: &'a Planes,
    /// The first picture that is read.
    pub(crate) first: usize,
    /// How many pictures.
    pub(crate) count: usize,
}

impl<'a> Source<'a> {
    /// The pictures, borders included.
    pub(super) fn pictures(&self) -> &'a [f32] {
        self.input.from(self.first, self.count)
    }
}
