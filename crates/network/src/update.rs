//! Consumers of gradients.

/// Receives the gradient of each parameter as soon as it is computed, while the gradient is in cache. At that time, the backward pass no longer needs
/// the old value of the parameter.
///
/// An optimiser updates the parameter; a test stores the gradient.
pub(crate) trait Update {
    /// Receives the gradient of the parameter at `slot` with the values `values`.
    fn update(&mut self, slot: usize, values: &mut [f32], gradient: &[f32]);
}
