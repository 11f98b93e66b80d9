//! Runs a plan on borrowed devices: safely, resumably, and without a clock or a file of its own.
//!
//! A press is an approach, a search for contact, its waypoints and a retreat. In contact the tip moves in segments of 15 ms, in longer ones
//! where threads look on and no limit is near; after each, force and pose are read and shown to the [`Supervisor`]. A limit of the gel ends the way in and the run goes on. Signals that are silent
//! break a press off, which is made again. Anything else stops the run: the tip leaves the gel if its signals can be trusted and the robot
//! reports no fault of its own, and the same call resumes the run.

mod align;
mod bounds;
mod by_hand;
mod camera;
mod change;
mod clearance;
mod devices;
mod enabling_wait;
mod error;
mod event;
mod halt_reason;
mod indent;
mod load_limit;
mod log;
mod motion;
mod observe;
mod operator;
mod oversight;
mod press;
mod reading;
mod reference_touch;
mod retreat;
#[cfg(test)]
mod rig;
mod sample;
mod search;
mod session;
mod session_start;
mod stride;
mod supervisor;
mod tap;
#[cfg(test)]
mod tests;
mod time;
mod tip;
mod way;
mod zero;

pub use align::wrench_between;
pub use clearance::raise;
pub use devices::{Devices, SpecimenChanger};
pub use error::{Left, RunError, StopCause};
pub use event::Event;
pub use halt_reason::Trip;
pub use log::{PressLog, PressRecord};
pub use operator::{Answer, ChangedTouch, Operator, Question, Spot};
pub use oversight::Oversight;
pub use reference_touch::{ReferenceTouch, SessionRecord, SessionSpec, TouchFault};
pub use supervisor::{Enabling, MotionStage, Observation, SharedSupervisor, Supervisor};
pub use tap::{TapError, TapHeard, TapListener, Tapped, tap};
pub use time::{Cancel, Timekeeper};

use taceva_core::Millimetre;

use crate::plan::Plan;
use session::Run;

/// Which plan is run, on which unit, and whether for real.
#[derive(Clone, Copy, Debug)]
pub struct RunSpec<'a> {
    /// The plan.
    pub plan: &'a Plan,
    /// The unit that is on the rig; presses of others are left for another run.
    pub unit: &'a str,
    /// For real, or in the air.
    pub mode: Mode,
}

/// For real, or in the air.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mode {
    /// Presses are made and recorded.
    Acquire,
    /// Every place is visited this much above the height of travel, with the same loop and the same supervisor; nothing is recorded.
    Rehearse {
        /// Added to the clearance.
        height: Millimetre,
    },
}

/// Clock, cancellation and the receiver of events.
pub struct Controls<'a> {
    /// The clock that the stamps of the devices are of.
    pub clock: &'a mut dyn Timekeeper,
    /// Ends the run before its next motion.
    pub cancel: &'a Cancel,
    /// Is called with each event.
    pub events: &'a mut dyn FnMut(&Event),
    /// Does what no device can; where absent, a plan that needs hands stops there.
    pub operator: Option<&'a mut dyn Operator>,
}

/// What a run did, in counts.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RunReport {
    /// Presses of this unit that were finished before.
    pub resumed: usize,
    /// Presses that were made and are durable; in a rehearsal, places visited.
    pub made: usize,
    /// Times that a press was broken off because signals were silent, and made again.
    pub redone: u32,
    /// Of those made, ended by a limit of the gel.
    pub limited: usize,
    /// Of those made, without contact.
    pub without_contact: usize,
    /// Samples that were recorded.
    pub samples: usize,
    /// Presses that were left for another run, because somebody skipped what they need.
    pub skipped: usize,
}

/// Makes the presses of `spec` that `log` does not have yet, each durable before the next begins.
///
/// Sensor and transducer are started and stopped, the robot is left above the gel.
///
/// # Errors
/// [`RunError`]: what stopped it, which press must be made again, and where the tip was left.
pub fn run<'a>(
    spec: &RunSpec<'a>,
    devices: Devices<'a>,
    log: &mut dyn PressLog,
    controls: Controls<'a>,
) -> Result<RunReport, RunError> {
    run_under(spec, devices, log, controls, None)
}

/// Makes the presses of `spec` under `guard`, which threads of the caller show readings to.
///
/// # Errors
/// As [`run`]; of a session also [`StopCause::Rig`], [`StopCause::SlowGuard`] and [`StopCause::Touch`] where the rig is not as it should be.
/// Then nothing was pressed.
pub fn run_guarded<'a>(
    spec: &RunSpec<'a>,
    devices: Devices<'a>,
    log: &mut dyn PressLog,
    controls: Controls<'a>,
    guard: Oversight<'a>,
) -> Result<RunReport, RunError> {
    run_under(spec, devices, log, controls, Some(guard))
}

fn run_under<'a>(
    spec: &RunSpec<'a>,
    devices: Devices<'a>,
    log: &mut dyn PressLog,
    controls: Controls<'a>,
    guard: Option<Oversight<'a>>,
) -> Result<RunReport, RunError> {
    let stopped = |cause| RunError {
        press: None,
        cause,
        left: Left::Clear,
    };
    let mut run = Run::new(spec, devices, controls, guard).map_err(stopped)?;
    let done = run.all(spec, log);
    let stopping = run.stop();
    match done {
        Ok(report) => stopping.map(|()| report).map_err(stopped),
        Err(error) => Err(error),
    }
}
