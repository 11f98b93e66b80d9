//! Labels of pictures: numbers or classes.

/// Labels of pictures.
#[derive(Clone, Copy, Debug)]
pub enum Labels<'a> {
    /// Numbers in any unit, shape `[samples, outputs]`.
    Values(&'a [f64]),
    /// Class of each sample, below the number of outputs.
    Classes(&'a [u32]),
}
