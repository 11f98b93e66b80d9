//! How far predictions are from the truth: the sums of each channel's pairs, and of the distances in planes.

mod gate;
mod mae_euclid;
pub(crate) mod pair_sums;
pub(crate) mod pairs;
mod plane;
pub(crate) mod plane_sums;
#[cfg(feature = "ndarray")]
mod views;

pub(crate) use gate::gate;
pub(crate) use mae_euclid::MAE_EUCLID;
pub(crate) use pairs::outputs;
