//! Output buffers of the passes of a convolution.

use super::ending::{Epilogue, Onto};
use crate::planes::Planes;

/// Output of the forward pass of a convolution.
pub(crate) struct Target<'a> {
    pub(crate) pictures: &'a mut Planes,
    /// Bias and operations applied to the sums.
    pub(crate) epilogue: Epilogue<'a>,
}

/// Output of the input-gradient pass of a convolution.
pub(crate) struct GradientTarget<'a> {
    pub(crate) gradient: &'a mut Planes,
    /// Mode of writing the gradient.
    pub(crate) onto: Onto,
}

impl GradientTarget<'_> {
    /// Target that writes to `gradient` in the mode `onto`.
    pub(crate) fn new(gradient: &mut Planes, onto: Onto) -> GradientTarget<'_> {
        GradientTarget { gradient, onto }
    }
}
