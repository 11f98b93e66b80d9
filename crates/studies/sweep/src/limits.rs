//! What is too much.

/// The largest grid that is carried out.
pub const MOST_TASKS: u64 = 1_000_000;
