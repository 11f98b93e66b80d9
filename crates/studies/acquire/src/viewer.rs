//! Viewer of devices during a run.

use taceva_core::{Frame, Pose, Wrench};
use taceva_dataset::StreamFacts;
use taceva_protocol::{ContentId, Event, Plan};

/// Viewer of devices during a run, such as a page. The thread of the run makes every call, so an implementation must return at once.
pub trait Viewer: Send + Sync {
    /// Presses of `unit` begin. `is_recorded` is true for presses that are skipped because they are recorded.
    fn begins(&self, plan: &Plan, unit: &str, is_recorded: &dyn Fn(ContentId) -> bool);
    /// An event of the run.
    fn event(&self, event: &Event);
    /// A captured frame.
    fn frame(&self, frame: &Frame);
    /// A force reading after subtraction of its zero.
    fn force(&self, wrench: &Wrench);
    /// Pose of the tip, in the frame of the sensor.
    fn pose(&self, pose: &Pose);
    /// Counts of lost frames.
    fn lost(&self, stream: StreamFacts);
}
