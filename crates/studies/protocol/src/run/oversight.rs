//! Guard of a run: the supervisor, and the checks before the first press.

use super::reference_touch::SessionSpec;
use super::supervisor::SharedSupervisor;

/// Guard of a run: threads watch the robot while it moves.
///
/// `supervisor` watches the robot of the run. One thread of the caller passes every force reading to it, and another thread passes poses during motions. The
/// transducer of the run only returns readings of the first thread.
pub struct Oversight<'a> {
    pub(super) supervisor: SharedSupervisor,
    pub(super) session: Option<SessionSpec<'a>>,
    pub(super) patience_s: f64,
}

impl<'a> Oversight<'a> {
    /// Creates a guard without a session. The guard does not wait for an enabling switch.
    pub fn new(supervisor: SharedSupervisor) -> Oversight<'a> {
        Oversight {
            supervisor,
            session: None,
            patience_s: 0.0,
        }
    }

    /// Adds a session on the rig of a rig file. The longest wait for the enabling switch is that of the file.
    ///
    /// Before the first press, the operator enables the robot. The tip then moves through the air and touches the gel gently. The touch is compared
    /// with the rig file and with earlier sessions of the recording.
    #[must_use]
    pub fn with_session(self, session: SessionSpec<'a>) -> Oversight<'a> {
        Oversight {
            patience_s: session.rig.patience_s(),
            session: Some(session),
            ..self
        }
    }

    /// Sets the longest time to wait until the enabling switch is held, in s.
    #[must_use]
    pub fn with_patience_s(self, patience_s: f64) -> Oversight<'a> {
        Oversight { patience_s, ..self }
    }
}
