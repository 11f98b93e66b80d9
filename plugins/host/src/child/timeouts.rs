//! How long a host waits for its child.

use std::time::Duration;

/// How long a host waits before it ends a child that does not answer.
///
/// A call that has a deadline is waited for until the deadline and [`grace`](Patience::grace) have passed on the clock of the machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patience {
    /// Until the child has confined itself and loaded its plugin.
    pub start: Duration,
    /// Until a device is open, and for every call without a deadline.
    pub open: Duration,
    /// Until a device is closed; a child that takes longer is ended.
    pub close: Duration,
    /// Beyond the deadline of a call, since simulated devices count the deadline on a clock of their own.
    pub grace: Duration,
    /// Until a halt is acknowledged, and until a call has ended after an interrupt.
    pub urgent: Duration,
    /// Until the child has ended after it was asked to.
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
