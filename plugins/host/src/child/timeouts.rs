//! Timeouts of a host for its child.

use std::time::Duration;

/// Timeouts after which a host kills a child that does not answer.
///
/// A call with a deadline times out [`grace`](Patience::grace) after the deadline, on the machine's clock.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Patience {
    /// From start until the child has confined itself and loaded its plugin.
    pub start: Duration,
    /// For opening a device and every call without a deadline.
    pub open: Duration,
    /// For closing a device.
    pub close: Duration,
    /// Time added to the deadline of a call, because simulated devices count deadlines on their own clock.
    pub grace: Duration,
    /// For acknowledging a halt, and for ending a call after an interrupt.
    pub urgent: Duration,
    /// For ending after the order to end.
    pub end: Duration,
}

impl Default for Patience {
    /// Long timeouts that distinguish a hanging child from a slow one on a busy machine.
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
