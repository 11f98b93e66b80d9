//! Fitted parameters, kept as tensors, and how they predict: by our code, in an order that is always the same.

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

/// The error of tensors that no fit gives.
pub(crate) fn damaged(why: &str) -> ModelError {
    ModelError::new(ErrorKind::Protocol, why)
}
