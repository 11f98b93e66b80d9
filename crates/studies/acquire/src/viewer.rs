//! Who looks on while devices work.

use taceva_core::{Frame, Pose, Wrench};
use taceva_dataset::StreamFacts;
use taceva_protocol::{ContentId, Event, Plan};

/// Somebody who looks on while devices work, such as a page. Every call comes from the thread that conducts the run, so an implementation must
/// return at once and never wait.
pub trait Viewer: Send + Sync {
    /// Presses of `unit` begin, but for those that are recorded already.
    fn begins(&self, plan: &Plan, unit: &str, is_recorded: &dyn Fn(ContentId) -> bool);
    /// Something happened in a run.
    fn event(&self, event: &Event);
    /// A frame was taken.
    fn frame(&self, frame: &Frame);
    /// The transducer read this; its zero is taken off.
    fn force(&self, wrench: &Wrench);
    /// The tip is here, in the sensor's frame.
    fn pose(&self, pose: &Pose);
    /// So much of a stream of frames was lost.
    fn lost(&self, stream: StreamFacts);
}
