//! Plugins that each misbehave in one way: the host survives and reports the fault.

mod escape;
mod plugin;
mod quarantine;
mod ways;
