//! Guard of a run: who watches the robot while it moves, and what must be tried before the first press.

use super::reference_touch::SessionSpec;
use super::supervisor::SharedSupervisor;

/// Guard of a run on a robot that threads watch.
///
/// `supervisor` is over the robot of the run. A thread of the caller shows it every reading of force, another one poses under way; the
/// transducer of the run only passes on the readings of that thread.
pub struct Oversight<'a> {
    pub(super) supervisor: SharedSupervisor,
    pub(super) session: Option<SessionSpec<'a>>,
    pub(super) patience_s: f64,
}

impl<'a> Oversight<'a> {
    /// A guard without a session, whose run does not wait for an enabling switch.
    pub fn new(supervisor: SharedSupervisor) -> Oversight<'a> {
        Oversight {
            supervisor,
            session: None,
            patience_s: 0.0,
        }
    }

    /// The guard of a session on the rig of a rig file, whose patience is that of the file.
    ///
    /// Before the first press somebody enables the robot, the tip passes through the air and touches the gel gently. The touch is compared with
    /// the rig file and with earlier sessions of the recording.
    #[must_use]
    pub fn with_session(self, session: SessionSpec<'a>) -> Oversight<'a> {
        Oversight {
            patience_s: session.rig.patience_s(),
            session: Some(session),
            ..self
        }
    }

    /// The guard of a rig with an enabling switch, for which a run waits `patience_s` at most.
    #[must_use]
    pub fn with_patience_s(self, patience_s: f64) -> Oversight<'a> {
        Oversight { patience_s, ..self }
    }
}
