//! Direct convolution: sums of products of pixels and weights.

mod border;
mod correlation;
mod forward;
mod input_gradient;
mod single_picture;
mod weight_gradient;

pub(super) use forward::Forward;
pub(super) use input_gradient::InputGradient;
pub(super) use weight_gradient::WeightGradient;
