//! Version of the messages between a host and a plugin's process.

/// Wire version, increased by one with every change of a message. `tests/wire/` holds the golden bytes. A host and a child with different versions
/// reject each other.
pub const WIRE: u32 = 2;
