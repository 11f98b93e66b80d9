//! Recording of every device during one tap.

use taceva_core::{Frame, Pose, Stamp, Wrench};

use crate::run::session_start::picture::means;

/// Number of parts along each side of a frame. The mean brightness over the pixels of each part is recorded.
const PARTS: usize = 8;

/// Values of every device, from before a tap to the rest after it, each with the time of its stamp.
///
/// ```
/// use taceva_core::{Pose, Stamp};
/// use taceva_protocol::TapHeard;
/// let mut heard = TapHeard::default();
/// heard.pose(&Pose::default(), &Stamp { valid_s: 1.0, received_s: None });
/// assert_ne!(heard, TapHeard::default());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TapHeard {
    /// Heights of the tip in the sensor frame: pairs of a time in s and a height in mm.
    pub(super) heights: Vec<(f64, f64)>,
    pub(super) forces: Said,
    pub(super) frames: Said,
}

/// Values of one device in order, each with its time in s.
pub(super) type Said = Vec<(f64, Vec<f64>)>;

impl TapHeard {
    /// Adds the height of `pose` to the recording, unless its stamp is not newer than the last.
    pub fn pose(&mut self, pose: &Pose, stamp: &Stamp) {
        let is_news = self
            .heights
            .last()
            .is_none_or(|(last_s, _)| *last_s < stamp.valid_s);
        if is_news {
            self.heights.push((stamp.valid_s, pose.position.z.0));
        }
    }

    /// Adds a force reading of the transducer to the recording.
    pub fn force(&mut self, wrench: &Wrench, stamp: &Stamp) {
        let forces = wrench.force.map(|force| force.0).to_vec();
        add(&mut self.forces, forces, stamp);
    }

    /// Adds a frame of the sensor to the recording, as the mean brightness of its parts.
    pub fn frame(&mut self, frame: &Frame, stamp: &Stamp) {
        add(&mut self.frames, means(frame, PARTS), stamp);
    }
}

/// Adds a value to `said` if its stamp is newer than the last. Repeats are skipped, because a device may be read faster than it updates.
fn add(said: &mut Said, numbers: Vec<f64>, stamp: &Stamp) {
    if said
        .last()
        .is_none_or(|(last_s, _)| *last_s < stamp.valid_s)
    {
        said.push((stamp.valid_s, numbers));
    }
}
