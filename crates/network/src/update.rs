//! What is done with a gradient once it is known.

/// Takes the gradient of each parameter as soon as it is known, while it is still in a cache; the parameter's old value is needed
/// no more.
///
/// An optimiser changes the parameter; a test keeps the gradient.
pub(crate) trait Update {
    /// `gradient` of the parameter at `slot`, which holds `values`.
    fn update(&mut self, slot: usize, values: &mut [f32], gradient: &[f32]);
}
