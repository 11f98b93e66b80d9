//! The tensors of a model file, the limits of one, and why bytes are no model.

pub(crate) mod content;
pub(crate) mod error;
pub(crate) mod limits;
pub(crate) mod tensors;
