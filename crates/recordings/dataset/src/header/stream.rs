//! What became of the frames of a stream that was recorded as it came.

use serde::{Deserialize, Serialize};

/// Frames of a stream that are not in its recording, counted while it was made.
///
/// ```
/// use taceva_dataset::StreamFacts;
///
/// let facts = StreamFacts::new(true).with_lost(3, 1);
/// assert_eq!((facts.dropped, facts.damaged, facts.lost()), (3, 1, 4));
/// ```
#[non_exhaustive]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct StreamFacts {
    /// Whether the device or its link numbers frames, so that a frame which was not taken is noticed.
    pub numbered: bool,
    /// Frames for which there was no room when they came, and, of a device that numbers them, those that were not taken in time.
    pub dropped: u64,
    /// Frames that came damaged.
    pub damaged: u64,
}

impl StreamFacts {
    /// A stream of which nothing was lost yet.
    pub fn new(numbered: bool) -> StreamFacts {
        StreamFacts {
            numbered,
            ..StreamFacts::default()
        }
    }

    /// The same with so many frames lost.
    #[must_use]
    pub fn with_lost(self, dropped: u64, damaged: u64) -> StreamFacts {
        StreamFacts {
            dropped,
            damaged,
            ..self
        }
    }

    /// Frames that are not in the recording.
    pub fn lost(self) -> u64 {
        self.dropped.saturating_add(self.damaged)
    }
}
