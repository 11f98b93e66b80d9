//! Output without end.

use std::time::{Duration, Instant};

/// Counts what a child puts out, anew after each [`Flood::WITHIN`].
#[derive(Debug)]
pub(super) struct Flood {
    most: u64,
    count: u64,
    since: Instant,
}

impl Flood {
    /// The time in which a count is a flood.
    pub(super) const WITHIN: Duration = Duration::from_secs(10);

    /// A count of which more than `most` is a flood.
    pub(super) fn new(most: u64) -> Flood {
        Flood {
            most,
            count: 0,
            since: Instant::now(),
        }
    }

    /// Adds to the count; true once it is a flood.
    pub(super) fn add(&mut self, count: u64) -> bool {
        if self.since.elapsed() > Flood::WITHIN {
            (self.count, self.since) = (0, Instant::now());
        }
        self.count = self.count.saturating_add(count);
        self.count > self.most
    }
}
