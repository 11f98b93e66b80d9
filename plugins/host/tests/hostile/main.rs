//! Plugins that misbehave, each in its own way: the host is alive after each, and says what happened.

mod escape;
mod plugin;
mod quarantine;
mod ways;
