//! Limits of a sweep.

/// Maximum number of tasks in a grid.
pub const MOST_TASKS: u64 = 1_000_000;
