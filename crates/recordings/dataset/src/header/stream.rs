//! Frame losses of a recorded stream.

use serde::{Deserialize, Serialize};

/// Numbers of stream frames that are missing in the recording, counted while recording.
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
    /// True if the device or its link numbers frames, so that missing frames are detected.
    pub numbered: bool,
    /// Frames dropped because a buffer was full and, if the device numbers frames, frames not fetched in time.
    pub dropped: u64,
    /// Frames that arrived damaged.
    pub damaged: u64,
}

impl StreamFacts {
    /// Stream without losses.
    pub fn new(numbered: bool) -> StreamFacts {
        StreamFacts {
            numbered,
            ..StreamFacts::default()
        }
    }

    /// The same stream with `dropped` and `damaged` frames.
    #[must_use]
    pub fn with_lost(self, dropped: u64, damaged: u64) -> StreamFacts {
        StreamFacts {
            dropped,
            damaged,
            ..self
        }
    }

    /// Number of frames that the recording lacks.
    pub fn lost(self) -> u64 {
        self.dropped.saturating_add(self.damaged)
    }
}
