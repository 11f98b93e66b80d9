//! Limit on the output of a child.

use std::time::{Duration, Instant};

/// Counter of a child's output, restarted every [`Flood::WITHIN`].
#[derive(Debug)]
pub(super) struct Flood {
    most: u64,
    count: u64,
    since: Instant,
}

impl Flood {
    /// Time after which the counter restarts.
    pub(super) const WITHIN: Duration = Duration::from_secs(10);

    /// Counter with the limit `most`.
    pub(super) fn new(most: u64) -> Flood {
        Flood {
            most,
            count: 0,
            since: Instant::now(),
        }
    }

    /// Adds `count`. Returns true if the sum exceeds the limit.
    pub(super) fn add(&mut self, count: u64) -> bool {
        if self.since.elapsed() > Flood::WITHIN {
            (self.count, self.since) = (0, Instant::now());
        }
        self.count = self.count.saturating_add(count);
        self.count > self.most
    }
}
