//! Labels of pictures: numbers or classes.

/// The labels of pictures.
#[derive(Clone, Copy, Debug)]
pub enum Labels<'a> {
    /// `[samples, outputs]`, in any unit.
    Values(&'a [f64]),
    /// The class of each sample, below the number of outputs.
    Classes(&'a [u32]),
}
