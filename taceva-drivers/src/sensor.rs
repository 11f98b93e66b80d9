//! The sensors that are built in.

pub(crate) mod replay;
