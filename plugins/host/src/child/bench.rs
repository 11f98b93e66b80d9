//! Simulated bench of a plugin: proxy in the host and server in the child.

mod proxy;
mod serve;

pub(super) use proxy::BenchProxy;
pub(super) use serve::serve;
