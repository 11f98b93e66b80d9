//! A model on both sides of the socket: made, asked and kept.

mod proxy;
mod serve;

pub(super) use proxy::{ModelProxy, of_failure, of_link};
pub(super) use serve::serve;
