//! What a driver promises, through the tables.

mod bench;
mod changer;
mod force;
mod library;
mod robot;
mod sensor;

use std::time::Duration;

/// In nanoseconds.
const SECOND: u64 = 1_000_000_000;
/// Within which a blocked call answers an interrupt or a halt.
const AT_ONCE: Duration = Duration::from_millis(50);
