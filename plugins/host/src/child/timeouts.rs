//! Timeouts of a host for its child.

use std::time::Duration;

/// Timeouts after which a host kills a child that does not answer.
///
/// A call with a deadline times out [`grace`](Patience::grace) after the deadline, on the machine's clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patience {
    /// Timeout from the start until the child has confined itself and loaded its plugin.
    pub start: Duration,
    /// Timeout for opening a device and for every call without a deadline.
    pub open: Duration,
    /// Timeout for closing a device.
    pub close: Duration,
    /// Time added to the deadline of a call, because simulated devices count deadlines on their own clock.
    pub grace: Duration,
    /// Timeout for confirming a halt, and for ending a call after an interrupt.
    pub urgent: Duration,
    /// Timeout for ending after the order to end.
    pub end: Duration,
}

impl Default for Patience {
    /// Default timeouts. They are long, so that a slow child on a busy machine does not count as hanging.
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
