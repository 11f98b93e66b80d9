//! Model: proxy in the host and server in the child.

mod proxy;
mod serve;

pub(super) use proxy::{ModelProxy, of_failure, of_link};
pub(super) use serve::serve;
