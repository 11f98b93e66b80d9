//! Built-in sensors.

pub(crate) mod replay;
