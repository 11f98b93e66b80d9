//! `rig teach`: the operator jogs the robot to three places, which determine the origin and axes in the rig file.

use std::time::Duration;

use taceva_core::{Deadline, Pose, Robot};
use taceva_drivers::Drivers;
use taceva_protocol::{
    Answer, Cancel, Jogged, Operator, Question, RigFile, SceneProblem, Spot, Taught, TeachError,
};

use crate::error::AcquireError;
use crate::presses::FileOpener;

/// Deadline for each pose.
const DEADLINE: Deadline = Deadline::after(Duration::from_secs(2));

/// Asks `operator` to jog the robot of `rig` to three places. Returns the frame that they define, and the text of the rig file with this frame. The program
/// does not move the robot.
///
/// # Errors
/// [`AcquireError::Scene`] with the line of the rig file if it names no robot or the places define no frame. [`AcquireError::OpenOfRig`] and
/// [`AcquireError::Device`] if the robot does not respond. [`AcquireError::Request`] if the operator stopped.
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
    let refused = |error: TeachError| {
        let problem = SceneProblem::Contradiction(error.to_string());
        AcquireError::from(rig.error(written.axes.at(), problem))
    };
    let (middle, along_x) = (jog(Spot::Middle)?, jog(Spot::AlongX)?);
    Jogged::check_x(&middle, &along_x).map_err(refused)?;
    let jogged = Jogged {
        middle,
        along_x,
        along_y: jog(Spot::AlongY)?,
    };
    let taught = jogged.taught(written.carries).map_err(refused)?;
    let text = rig.with_taught(&taught).ok_or_else(missing)?;
    Ok((taught, text))
}

/// Pose of the robot after the operator has jogged the robot.
fn stood(
    robot: &mut dyn Robot,
    spot: Spot,
    operator: &mut dyn Operator,
) -> Result<Pose, AcquireError> {
    match operator.ask(&Question::Jog(spot), &Cancel::new()) {
        Answer::Done => Ok(robot.pose(DEADLINE)?.0),
        Answer::Skip | Answer::Stop => Err(AcquireError::Request(
            "stopped: the rig file is unchanged".to_owned(),
        )),
    }
}
