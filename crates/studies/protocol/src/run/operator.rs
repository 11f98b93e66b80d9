//! Operator of a rig, and the questions for manual steps.

use std::fmt;

use taceva_core::{Fault, Specimen};

use super::time::Cancel;

/// Operator at a terminal or on a page. Nothing moves before the answer, which has no deadline.
pub trait Operator {
    /// Asks `question` and waits for the answer; returns [`Answer::Stop`] soon after `cancel` was cancelled.
    fn ask(&mut self, question: &Question, cancel: &Cancel) -> Answer;

    /// Asks the operator to hold the enabling switch within `patience_s`, in s. Returns immediately; does nothing by default.
    fn call_to_hold(&mut self, _patience_s: f64) {}

    /// Shows a warning of a device about valid readings, with its remedy. Returns immediately; does nothing by default.
    fn warn(&mut self, _warning: &str) {}

    /// Shows a finding of the session, such as the stiffness of the gel. Returns immediately; does nothing by default.
    fn note(&mut self, _finding: &str) {}
}

/// Questions to the operator. [`Display`](fmt::Display) writes their text.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Question {
    /// Enable a robot: the operator types the name of the robot or presses a button with this name.
    Enable {
        /// Name of the robot.
        robot: String,
        /// Description of the next motions of the robot.
        way: String,
    },
    /// Mount this specimen on the robot, unrotated.
    Mount(Specimen),
    /// Put this unit of the sensor under the robot.
    Unit(String),
    /// Set this light scene.
    Light(String),
    /// Check and acknowledge this fault at the robot. Afterwards the robot can move again.
    Acknowledge(Fault),
    /// Remove every load from the force transducer.
    Unload,
    /// Hang a weight of this mass, in g, on the force transducer.
    Hang {
        /// Mass, in g.
        mass_g: f64,
    },
    /// Jog the tip to this place with the controls of the robot.
    Jog(Spot),
    /// Do a step by hand instead of the changer, because the changer failed.
    Instead {
        /// The step of the changer: [`Mount`](Question::Mount) or [`Unit`](Question::Unit).
        of_changer: Box<Question>,
        /// Reason why the changer failed.
        why: String,
    },
    /// Remove all hands from the reach of the robot. After a skipped step, the robot continues with presses that need no operator.
    GoOn,
    /// Continue although the gentle touch differs from that of an earlier session of this recording.
    Resume(ChangedTouch),
}

/// Places over the gel to which the operator jogs the robot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Spot {
    /// Middle of the gel.
    Middle,
    /// Place displaced from the middle along x of the sensor.
    AlongX,
    /// Place displaced from the middle along y of the sensor.
    AlongY,
}

/// Difference between the gentle touch of a session and that of an earlier session.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChangedTouch {
    /// Change of the height of the gel, in mm. Above zero, the surface is now farther from the tip.
    pub height_mm: f64,
    /// Relative change of the force at equal depth: 0.1 for a force that is 10 % greater.
    pub force_part: f64,
    /// Expanded uncertainty of the change of the height, in mm; coverage factor 2.
    pub height_u_mm: f64,
    /// Expanded uncertainty of the relative change of the force; coverage factor 2.
    pub force_u_part: f64,
}

/// Answers of the operator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// The step is done, and all hands are out of reach.
    Done,
    /// The step is not possible now. The run skips presses that need it.
    Skip,
    /// Stop the run.
    Stop,
}

impl fmt::Display for Question {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Question::Enable { robot, way } => write!(
                f,
                "`{}` is about to move: {way}; keep your hands clear and the emergency stop within reach",
                taceva_core::shown(robot)
            ),
            Question::Unload => f.write_str(
                "take every load off the force transducer, and touch nothing until the next question",
            ),
            Question::Hang { mass_g } => write!(
                f,
                "hang {mass_g} g on the force transducer, or lay the weight on it, so that the weight acts along z only; let it rest, and touch nothing",
            ),
            Question::Jog(Spot::Middle) => f.write_str(
                "jog the tip with the robot's own controls until it just touches the middle of the gel, then let go",
            ),
            Question::Jog(Spot::AlongX) => f.write_str(
                "raise the tip off the gel by less than half a millimetre; then jog it 5 to 10 mm along x of the sensor only, such as to the right of its picture",
            ),
            Question::Jog(Spot::AlongY) => f.write_str(
                "return to the middle; then jog 5 to 10 mm along y of the sensor: a quarter turn clockwise from x, looking at the gel from outside",
            ),
            Question::Resume(ChangedTouch {
                height_mm,
                force_part,
                height_u_mm,
                force_u_part,
            }) => write!(
                f,
                "the gel surface is {:.3} ± {height_u_mm:.3} mm {} than in the last session, and the gel is {:.1} ± {:.1} % {}. Continue this recording if the gel is the same; stop if the gel was moved or replaced",
                height_mm.abs(),
                if *height_mm < 0.0 { "higher" } else { "deeper" },
                100.0 * force_part.abs(),
                100.0 * force_u_part,
                if *force_part < 0.0 { "softer" } else { "harder" }
            ),
            Question::Mount(specimen) => {
                let unrotated = match specimen {
                    Specimen::Sphere { .. } => "",
                    Specimen::Grating { .. } => ", unrotated",
                };
                write!(
                    f,
                    "mount the {specimen}{unrotated}; the robot is halted until you confirm"
                )
            }
            Question::Instead { of_changer, why } => write!(
                f,
                "the changer failed: {}; check that the changer has stopped and is out of the way, then do by hand: {of_changer}",
                taceva_core::shown(why)
            ),
            Question::Unit(unit) => write!(f, "put unit {} in place", taceva_core::shown(unit)),
            Question::GoOn => f.write_str(
                "the step is skipped: keep your hands clear, the robot continues with the other presses",
            ),
            Question::Light(light) => write!(f, "set the light `{}`", taceva_core::shown(light)),
            Question::Acknowledge(fault) => write!(
                f,
                "{fault}: inspect the rig, free the tip if it is stuck, and acknowledge the fault at the robot; the tip retreats once you confirm"
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::{GratingKind, Nanometre};

    use super::*;

    #[test]
    fn each_question_names_what_is_to_be_done() {
        let board = Specimen::Grating {
            kind: GratingKind::Dot,
            spacing: Nanometre(500_000),
        };
        for (question, word) in [
            (
                Question::Mount(board),
                "0.5 mm, unrotated; the robot is halted",
            ),
            (
                Question::Mount(Specimen::Sphere {
                    radius: Nanometre(2_000_000),
                }),
                "mount the sphere of radius 2 mm; the robot is halted until you confirm",
            ),
            (Question::Unit("b".to_owned()), "unit b"),
            (
                Question::Instead {
                    of_changer: Box::new(Question::Mount(board)),
                    why: "it is stuck".to_owned(),
                },
                "it is stuck; check that the changer has stopped and is out of the way, then do by hand: mount the dot",
            ),
            (Question::Light("S1".to_owned()), "`S1`"),
            (Question::Unload, "take every load off the force transducer"),
            (Question::Hang { mass_g: 100.0 }, "hang 100 g on the force"),
            (
                Question::Jog(Spot::AlongY),
                "a quarter turn clockwise from x, looking at the gel from outside",
            ),
            (Question::GoOn, "keep your hands clear"),
            (Question::Acknowledge(Fault::Collision), "collision"),
            (
                Question::Enable {
                    robot: "lab/arm".to_owned(),
                    way: "5 mm up".to_owned(),
                },
                "`lab/arm` is about to move: 5 mm up; keep",
            ),
            (
                Question::Resume(ChangedTouch {
                    height_mm: -0.25,
                    force_part: 0.125,
                    height_u_mm: 0.02,
                    force_u_part: 0.05,
                }),
                "0.250 ± 0.020 mm higher than in the last session, and the gel is 12.5 ± 5.0 % harder. Continue",
            ),
            (
                Question::Resume(ChangedTouch {
                    height_mm: 0.25,
                    force_part: -0.207,
                    height_u_mm: 0.02,
                    force_u_part: 0.05,
                }),
                "0.250 ± 0.020 mm deeper than in the last session, and the gel is 20.7 ± 5.0 % softer. Continue",
            ),
        ] {
            let text = question.to_string();
            assert!(text.contains(word), "{text}");
        }
    }
}
