//! A simulated bench of a plugin, as the host and the child each hold it.

mod proxy;
mod serve;

pub(super) use proxy::BenchProxy;
pub(super) use serve::serve;
