//! `rig teach`: somebody jogs the robot to three places, and the rig file learns where it stands.

use std::time::Duration;

use taceva_core::{Deadline, Pose, Robot};
use taceva_drivers::Drivers;
use taceva_protocol::{
    Answer, Cancel, Jogged, Operator, Question, RigFile, SceneProblem, Spot, Taught,
};

use crate::error::AcquireError;
use crate::presses::FileOpener;

/// A pose is asked for within this.
const DEADLINE: Deadline = Deadline::after(Duration::from_secs(2));

/// Asks `operator` to jog the robot of `rig` to three places, and returns what they say with the text of the rig file that says it.
/// Nothing is moved by the program.
///
/// # Errors
/// [`AcquireError::Scene`] with the line of the rig file if it names no robot or the places are no frame; [`AcquireError::Open`] and
/// [`AcquireError::Device`] if the robot does not answer; [`AcquireError::Request`] if somebody stopped.
pub fn teach_rig(
    rig: &RigFile,
    drivers: &Drivers,
    operator: &mut dyn Operator,
) -> Result<(Taught, String), AcquireError> {
    let missing =
        || AcquireError::from(rig.error(None, SceneProblem::MissingKey("robot".to_owned())));
    let written = rig.robot.as_ref().ok_or_else(missing)?;
    let opener = FileOpener::new(rig, drivers);
    let (mut robot, _) = opener.base_robot()?.ok_or_else(missing)?;
    let mut jog = |spot: Spot| stood(&mut *robot, spot, operator);
    let jogged = Jogged {
        middle: jog(Spot::Middle)?,
        along_x: jog(Spot::AlongX)?,
        along_y: jog(Spot::AlongY)?,
    };
    let taught = jogged.taught(written.carries).map_err(|error| {
        let problem = SceneProblem::Contradiction(error.to_string());
        AcquireError::from(rig.error(written.axes.at(), problem))
    })?;
    let text = rig.with_taught(&taught).ok_or_else(missing)?;
    Ok((taught, text))
}

/// Where the robot stands once somebody has jogged it there.
fn stood(
    robot: &mut dyn Robot,
    spot: Spot,
    operator: &mut dyn Operator,
) -> Result<Pose, AcquireError> {
    match operator.ask(&Question::Jog(spot), &Cancel::new()) {
        Answer::Done => Ok(robot.pose(DEADLINE)?.0),
        Answer::Skip | Answer::Stop => Err(AcquireError::Request(
            "stopped: the rig file stays as it was".to_owned(),
        )),
    }
}
