//! Guarantees of drivers, tested through the tables.

mod bench;
mod changer;
mod force;
mod library;
mod robot;
mod sensor;

use std::time::Duration;

/// One second, in nanoseconds.
const SECOND: u64 = 1_000_000_000;
/// Time within which a blocked call returns after an interrupt or a halt.
const AT_ONCE: Duration = Duration::from_millis(50);
