//! Model files: tensors, limits and errors.

pub(crate) mod content;
pub(crate) mod error;
pub(crate) mod limits;
pub(crate) mod tensors;
