//! Raising of the tip before an operator changes a part below it.

use taceva_core::{ForceTransducer, Robot};

use super::Controls;
use super::bounds::Bounds;
use super::enabling_wait::Attendant;
use super::error::{Left, RunError, StopCause};
use super::operator::{Answer, Operator, Question};
use super::supervisor::SharedSupervisor;
use super::time::Cancel;
use super::tip::{DEADLINE, Pace, Step, Tip};
use crate::plan::Plan;

/// Repeatability of the poses that arms report at rest, in mm.
const REPEATED_MM: f64 = 0.1;

/// Raises the tip straight to the travel height if it is lower. Halts the robot there, out of reach of hands. Returns true if the tip moved.
///
/// If `robot` is given, the operator must enable the robot of this name before it moves. A robot whose tip is high enough is only halted.
/// `supervisor` watches `arm` and receives every force reading, as under [`run_guarded`](super::run_guarded). With an enabling switch, nothing moves
/// until the switch is held, for up to `patience_s`.
///
/// # Errors
/// [`RunError`] for the causes of [`run`](super::run).
pub fn raise(
    plan: &Plan,
    arm: &mut dyn Robot,
    force: &mut dyn ForceTransducer,
    controls: Controls<'_>,
    supervisor: SharedSupervisor,
    robot: Option<&str>,
    patience_s: f64,
) -> Result<bool, RunError> {
    let Controls {
        clock,
        cancel,
        events,
        operator,
    } = controls;
    let nothing = || StopCause::Missing("limits and a footprint before anything moves".to_owned());
    let pace = Pace::of(plan).ok_or_else(|| unmoved(nothing()))?;
    let bounds = Bounds::of(plan, 0.0).ok_or_else(|| unmoved(nothing()))?;
    let mut tip = Tip {
        is_guarded: true,
        ..Tip::new(arm, force, clock, cancel, supervisor, bounds, pace)
    };
    let mut attendant = Attendant {
        operator,
        events,
        patience_s,
    };
    tip.find_pose().map_err(unmoved)?;
    if tip.is_high() {
        tip.hold().map_err(unmoved)?;
        return Ok(false);
    }
    if let Some(robot) = robot {
        let operator: Option<&mut dyn Operator> = match &mut attendant.operator {
            Some(operator) => Some(&mut **operator),
            None => None,
        };
        let way = format!("straight up to {} mm above the gel", tip.pace.clearance_mm);
        enable(robot, way, operator, cancel)?;
    }
    tip.wait_until_held(&mut attendant).map_err(unmoved)?;
    tip.force
        .start(DEADLINE)
        .map_err(|error| unmoved(error.into()))?;
    let raised = tip.find().and_then(|()| tip.hold());
    let stopped = tip.force.stop();
    if let Err(cause) = raised {
        return Err(tip.abandoned(cause, attendant));
    }
    stopped.map_err(|error| RunError {
        press: None,
        cause: error.into(),
        left: Left::Clear,
    })?;
    Ok(true)
}

/// Asks the operator to enable `robot` before its first motions, which the text `way` describes.
pub(super) fn enable(
    robot: &str,
    way: String,
    operator: Option<&mut dyn Operator>,
    cancel: &Cancel,
) -> Result<(), RunError> {
    let Some(operator) = operator else {
        let needed = format!("a person to enable `{robot}`");
        return Err(unmoved(StopCause::Missing(needed)));
    };
    let robot = robot.to_owned();
    match operator.ask(&Question::Enable { robot, way }, cancel) {
        Answer::Done => Ok(()),
        Answer::Skip | Answer::Stop => Err(unmoved(StopCause::Cancelled)),
    }
}

/// Builds the error for a run that ended before any motion.
fn unmoved(cause: StopCause) -> RunError {
    RunError {
        press: None,
        cause,
        left: Left::Untouched,
    }
}

impl Tip<'_> {
    /// True if the tip is at or above the travel height.
    pub(super) fn is_high(&self) -> bool {
        self.here().position.z.0 <= -self.pace.clearance_mm
    }

    /// True if the tip is at or above the travel height, within [`REPEATED_MM`].
    pub(super) fn is_about_high(&self) -> bool {
        self.here().position.z.0 <= REPEATED_MM - self.pace.clearance_mm
    }

    /// Halts the robot, whose tip is above the gel, until it is released by a call.
    pub(super) fn hold(&mut self) -> Step<()> {
        self.robot.halt()?;
        self.stands_clear = true;
        Ok(())
    }
}

#[cfg(test)]
mod tests;
