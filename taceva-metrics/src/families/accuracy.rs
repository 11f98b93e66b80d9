//! Accuracy of predictions: sums of the pairs of each channel, and of distances in planes such as `Pxy`.

mod gate;
pub(crate) mod pair_sums;
pub(crate) mod pairs;
pub(crate) mod plane;
pub(crate) mod plane_sums;
#[cfg(feature = "ndarray")]
mod views;

pub(crate) use gate::gate;
pub(crate) use pairs::outputs;
