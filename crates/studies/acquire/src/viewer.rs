//! Viewer of devices during a run.

use taceva_core::{Frame, Pose, Wrench};
use taceva_dataset::StreamFacts;
use taceva_protocol::{ContentId, Event, Plan};

/// Viewer of devices during a run, such as a page. The thread of the run makes every call, so implementations must return immediately.
pub trait Viewer: Send + Sync {
    /// Called when the presses of `unit` begin. `is_recorded` returns true for presses that are skipped because they are already recorded.
    fn begins(&self, plan: &Plan, unit: &str, is_recorded: &dyn Fn(ContentId) -> bool);
    /// Called for each event of the run.
    fn event(&self, event: &Event);
    /// Called for each captured frame.
    fn frame(&self, frame: &Frame);
    /// Called for each force reading. The force zero is already subtracted.
    fn force(&self, wrench: &Wrench);
    /// Called for each pose of the tip, in the frame of the sensor.
    fn pose(&self, pose: &Pose);
    /// Called with the counts of lost frames.
    fn lost(&self, stream: StreamFacts);
}
