//! A simulated bench on both sides of the socket.

mod proxy;
mod serve;

pub(super) use proxy::BenchProxy;
pub(super) use serve::serve;
