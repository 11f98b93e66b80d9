//! The person at a rig: what only hands can do, and how they are asked.

use std::fmt;

use taceva_core::{Fault, Specimen};

use super::time::Cancel;

/// Somebody who is asked, at a terminal or on a page. Nothing moves until the answer comes, and it has no deadline.
pub trait Operator {
    /// Asks `question` and waits for the answer; returns [`Answer::Stop`] soon after `cancel` was cancelled.
    fn ask(&mut self, question: &Question, cancel: &Cancel) -> Answer;
}

/// What somebody is asked for. [`Display`](fmt::Display) says it in words.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Question {
    /// Mount this specimen on the robot, turned straight.
    Mount(Specimen),
    /// Put this unit of the sensor under the robot.
    Unit(String),
    /// Set this scene of light.
    Light(String),
    /// Look what happened, and acknowledge this fault at the robot, which then moves again.
    Acknowledge(Fault),
}

/// What somebody answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Answer {
    /// It is done, and all hands are out of reach.
    Done,
    /// It cannot be done now: what needs it is left out of this run.
    Skip,
    /// The run ends here.
    Stop,
}

impl fmt::Display for Question {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Question::Mount(specimen) => write!(f, "mount the {specimen}, turned straight"),
            Question::Unit(unit) => write!(f, "put unit {} in place", taceva_core::shown(unit)),
            Question::Light(light) => write!(f, "set the light `{}`", taceva_core::shown(light)),
            Question::Acknowledge(fault) => write!(
                f,
                "{fault}: look, free the tip if it must be, and acknowledge the fault at the robot; it draws back as soon as you say so"
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
            (Question::Mount(board), "0.5 mm"),
            (Question::Unit("b".to_owned()), "unit b"),
            (Question::Light("S1".to_owned()), "`S1`"),
            (Question::Acknowledge(Fault::Collision), "collision"),
        ] {
            let text = question.to_string();
            assert!(text.contains(word), "{text}");
        }
    }
}
