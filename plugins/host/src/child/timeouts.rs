//! How long a host waits for its child.

use std::time::Duration;

/// How long a host waits before it ends a child that does not answer.
///
/// A call that has a deadline is waited for until the deadline and [`grace`](Patience::grace) have passed on the clock of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patience {
    /// For it to confine itself and load its plugin.
    pub start: Duration,
    /// For a device to open, and for whatever has no deadline.
    pub open: Duration,
    /// For a device to close: nothing of value is lost with one that does not.
    pub close: Duration,
    /// Beyond the deadline of a call: simulated devices count that on a clock of their own.
    pub grace: Duration,
    /// For a halt, and for a call to end after an interrupt.
    pub urgent: Duration,
    /// For it to end after it was asked to.
    pub end: Duration,
}

impl Default for Patience {
    /// Generous: it tells what hangs from what is slow on a busy machine.
    fn default() -> Patience {
        Patience {
            start: Duration::from_secs(20),
            open: Duration::from_secs(30),
            close: Duration::from_secs(5),
            grace: Duration::from_secs(5),
            urgent: Duration::from_secs(1),
            end: Duration::from_secs(2),
        }
    }
}
