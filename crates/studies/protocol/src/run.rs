//! Runs a plan on borrowed devices: safely, resumably, and without its own clock or files.
//!
//! A press is an approach, a search for contact, its waypoints and a retreat. In contact the tip moves in segments of 15 ms, or in longer segments if
//! guard threads run and no limit is near. After each segment, force and pose are read and checked by the [`Supervisor`]. A limit of the gel ends the
//! descent, and the run continues. A press is repeated if signals become stale, the zero of the force changes, or the enabling switch is released.
//! Any other cause stops the run, and the same call resumes it. At a stop, the tip leaves the gel if force, pose and robot are reliable.

mod align;
mod bounds;
mod by_hand;
mod camera;
mod change;
mod clearance;
mod depth_zero;
mod devices;
mod enabling_wait;
mod error;
mod event;
mod force_zero;
mod halt_reason;
mod indent;
mod load_cycle;
mod load_limit;
mod log;
mod motion;
mod observe;
#[cfg(test)]
mod one_press;
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
mod shear_way;
mod stride;
mod supervisor;
mod surface_fit;
mod tap;
#[cfg(test)]
mod tests;
mod time;
mod tip;
mod way;
mod zero;

pub use align::wrench_between;
pub use clearance::raise;
pub use depth_zero::{DepthZero, ZeroUnknown};
pub use devices::{Devices, SpecimenChanger};
pub use error::{Left, RunError, StopCause};
pub use event::Event;
pub use force_zero::{ForceZero, ZeroStep};
pub use halt_reason::Trip;
pub use log::{PressLog, PressRecord};
pub use operator::{Answer, ChangedTouch, Operator, Question, Spot};
pub use oversight::Oversight;
pub use reference_touch::{ReferenceTouch, SessionRecord, SessionSpec, TouchFault};
pub use shear_way::ShearFault;
pub use supervisor::{Enabling, MotionStage, Observation, SharedSupervisor, Supervisor};
pub use tap::{TapError, TapHeard, TapListener, Tapped, tap};
pub use time::{Cancel, Timekeeper};

use taceva_core::Millimetre;

use crate::plan::Plan;
use session::Run;

/// Plan, unit and mode of a run.
#[derive(Clone, Copy, Debug)]
pub struct RunSpec<'a> {
    /// Plan to execute.
    pub plan: &'a Plan,
    /// Unit of the sensor that is on the rig. Presses of other units need another run.
    pub unit: &'a str,
    /// Acquisition or rehearsal.
    pub mode: Mode,
}

/// Acquisition or rehearsal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Mode {
    /// Makes and records presses.
    Acquire,
    /// Visits every place in the air above the travel height, with the loop and the supervisor of an acquisition. Nothing is recorded.
    Rehearse {
        /// Height above the clearance at which places are visited.
        height: Millimetre,
    },
}

/// Clock, cancellation, operator and event callback of a run.
pub struct Controls<'a> {
    /// Clock that stamps the samples of the devices.
    pub clock: &'a mut dyn Timekeeper,
    /// Cancellation, which stops the run before its next motion.
    pub cancel: &'a Cancel,
    /// Callback for events.
    pub events: &'a mut dyn FnMut(&Event),
    /// Operator for manual steps. Without an operator, a run stops at the first such step.
    pub operator: Option<&'a mut dyn Operator>,
}

/// Numbers of presses and samples of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct RunReport {
    /// Number of presses of this unit that earlier runs finished.
    pub resumed: usize,
    /// Number of presses that this run recorded. In a rehearsal, number of visited places.
    pub made: usize,
    /// Number of repetitions of presses, after stale signals, a changed zero of the force or a released enabling switch.
    pub redone: u32,
    /// Number of presses of this run that a limit of the gel ended.
    pub limited: usize,
    /// Number of presses of this run that found no contact.
    pub without_contact: usize,
    /// Number of samples recorded in this run.
    pub samples: usize,
    /// Number of presses that are left for another run, because the operator skipped a step before them.
    pub skipped: usize,
}

/// Makes the presses of `spec` that are missing in `log`. Each press is safely stored before the next begins.
///
/// Starts and stops sensor and transducer. At the end, the robot is above the gel.
///
/// # Errors
/// [`RunError`] with the cause, the press to repeat, and the place of the tip.
pub fn run<'a>(
    spec: &RunSpec<'a>,
    devices: Devices<'a>,
    log: &mut dyn PressLog,
    controls: Controls<'a>,
) -> Result<RunReport, RunError> {
    run_under(spec, devices, log, controls, None)
}

/// Makes the presses of `spec` while the threads of `guard` read the devices and pass the readings to the supervisor.
///
/// # Errors Errors of [`run`]. A session on a real rig also fails with [`StopCause::Rig`], [`StopCause::SlowGuard`] or [`StopCause::Touch`] before
/// its first press.
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
