//! Labels of pictures: numbers or classes.

/// The labels of pictures.
#[derive(Clone, Copy, Debug)]
pub enum Labels<'a> {
    /// Numbers, `[samples, outputs]`, in any unit.
    Values(&'a [f64]),
    /// Class of each sample, below the number of outputs.
    Classes(&'a [u32]),
}
