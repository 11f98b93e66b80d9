//! Detects a camera that repeats a sequence of old frames, such as a camera whose ring buffer is no longer filled.

use std::collections::VecDeque;
use std::hash::{DefaultHasher, Hash, Hasher};

use taceva_core::Frame;

use super::moment::Moment;

/// Number of earlier frames with which a frame is compared. It is at least the number of buffers of a camera.
const COMPARED: usize = 16;

/// Digests of the last distinct frames, and the number of repeats of them.
#[derive(Default)]
pub(super) struct Cycle {
    frames: VecDeque<Old>,
    returns: u32,
}

/// An earlier frame that differed from all compared frames before it.
struct Old {
    digest: u64,
    moment: Moment,
}

impl Cycle {
    /// Number of repeated older frames since the last new frame, including `frame`, captured at `moment`. A repeat counts only if the tip moved and
    /// the force changed since the older frame.
    pub(super) fn returns(&mut self, frame: &Frame, moment: Moment) -> u32 {
        let mut hasher = DefaultHasher::new();
        frame.bytes().hash(&mut hasher);
        let digest = hasher.finish();
        match self.frames.iter().find(|old| old.digest == digest) {
            Some(Old { moment: old, .. }) => {
                let must_differ =
                    moment.is_moved_from(old) && moment.is_pressed_otherwise_than(old);
                self.returns += u32::from(must_differ);
            }
            None => {
                self.returns = 0;
                self.frames.push_back(Old { digest, moment });
                if self.frames.len() > COMPARED {
                    self.frames.pop_front();
                }
            }
        }
        self.returns
    }
}
