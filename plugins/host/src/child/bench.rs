//! A plugin's simulated bench, on the host side and on the child side.

mod proxy;
mod serve;

pub(super) use proxy::BenchProxy;
pub(super) use serve::serve;
