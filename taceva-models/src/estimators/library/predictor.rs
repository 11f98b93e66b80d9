//! Predictors of library models. Parameters are stored as tensors. This crate computes the predictions itself, always in the same order of
//! operations.

mod linear;
#[cfg(feature = "linfa")]
mod planes;
mod support;
#[cfg(feature = "smartcore")]
mod trees;

pub(crate) use self::linear::{Linear, Weighted};
#[cfg(feature = "linfa")]
pub(crate) use self::planes::{Classes, Planes};
pub(crate) use self::support::{Machine, Support};
#[cfg(feature = "smartcore")]
pub(crate) use self::trees::{Node, Tree, Trees};
use taceva_core::{ErrorKind, ModelError};

/// Error for a model file whose tensors cannot result from a fit. `why` names the fault.
pub(crate) fn damaged(why: &str) -> ModelError {
    ModelError::new(ErrorKind::Protocol, why)
}
