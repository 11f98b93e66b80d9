//! Viewer of devices at work.

use taceva_core::{Frame, Pose, Wrench};
use taceva_dataset::StreamFacts;
use taceva_protocol::{ContentId, Event, Plan};

/// Viewer of devices at work, such as a page. The thread that conducts the run makes every call, so an implementation must return at once.
pub trait Viewer: Send + Sync {
    /// Presses of `unit` begin; those recorded already are skipped.
    fn begins(&self, plan: &Plan, unit: &str, is_recorded: &dyn Fn(ContentId) -> bool);
    /// An event of the run.
    fn event(&self, event: &Event);
    /// A captured frame.
    fn frame(&self, frame: &Frame);
    /// A force reading, after subtraction of its zero.
    fn force(&self, wrench: &Wrench);
    /// Pose of the tip, in the sensor's frame.
    fn pose(&self, pose: &Pose);
    /// Losses of the stream of frames.
    fn lost(&self, stream: StreamFacts);
}
