//! The version of what a host and the process of a plugin say to each other.

/// It grows by one with every change of a message, of which the bytes in `tests/wire/` tell: a host and a child of different builds refuse
/// each other by it, and neither guesses what the other means.
pub const WIRE: u32 = 1;
