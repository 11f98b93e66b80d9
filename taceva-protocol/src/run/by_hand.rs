//! What a press needs and no device of the rig can do: somebody is asked, and nothing moves meanwhile.

use taceva_core::Fault;

use super::error::{RunError, StopCause};
use super::event::Event;
use super::operator::{Answer, Question};
use super::session::Run;
use super::tip::Step;
use crate::plan::PlannedPress;

impl Run<'_> {
    /// Mounts the specimen and sets the light of a press that hands must change; whether somebody skipped one of them.
    pub(super) fn is_skipped(&mut self, planned: &PlannedPress) -> Result<bool, RunError> {
        let failed = |run: &mut Self, cause| run.abandoned(Some(planned.id), cause);
        for question in self.needed_by_hand(planned) {
            if self.skipped.contains(&question) {
                return Ok(true);
            }
            match self.ask(&question) {
                Ok(Answer::Done) => self.done_by_hand(&question),
                Ok(Answer::Skip) => {
                    self.skipped.push(question);
                    return Ok(true);
                }
                Ok(Answer::Stop) => return Err(failed(self, StopCause::Cancelled)),
                Err(cause) => return Err(failed(self, cause)),
            }
        }
        Ok(false)
    }

    /// What hands must change before `planned`, where there is somebody.
    fn needed_by_hand(&mut self, planned: &PlannedPress) -> Vec<Question> {
        let press = &planned.press;
        let has_lighting = self.lighting.is_some()
            || self
                .camera
                .as_mut()
                .is_some_and(|camera| camera.sensor.lighting().is_some());
        let mut needed = Vec::new();
        if self.operator.is_none() {
            return needed;
        }
        if self.specimens.is_none() && self.mounted != Some(press.specimen) {
            needed.push(Question::Mount(press.specimen));
        }
        if let Some(light) = &press.light
            && !has_lighting
            && self.lit.as_ref() != Some(light)
        {
            needed.push(Question::Light(light.clone()));
        }
        needed
    }

    fn done_by_hand(&mut self, question: &Question) {
        match question {
            Question::Mount(specimen) => {
                self.mounted = Some(*specimen);
                // Another specimen is another load on the transducer.
                self.tip.is_zero_known = false;
                (self.events)(&Event::Mounted(*specimen));
            }
            Question::Light(light) => {
                self.lit = Some(light.clone());
                (self.events)(&Event::Lit(light.clone()));
            }
            _ => {}
        }
    }

    /// Asks while the robot is halted, and lets it move again only if hands are out of reach.
    fn ask(&mut self, question: &Question) -> Step<Answer> {
        let Some(operator) = &mut self.operator else {
            return Ok(Answer::Stop);
        };
        self.tip.robot.halt()?;
        let answer = operator.ask(question, self.tip.cancel);
        if answer == Answer::Done {
            self.tip.release()?;
        }
        Ok(answer)
    }

    /// After a fault of the robot: somebody looks and acknowledges it there, then the tip leaves the gel.
    pub(super) fn go_on_after(&mut self, fault: Fault, error: RunError) -> Result<(), RunError> {
        let Some(operator) = &mut self.operator else {
            return Err(error);
        };
        let question = Question::Acknowledge(fault);
        if operator.ask(&question, self.tip.cancel) != Answer::Done {
            return Err(error);
        }
        self.tip.robot_failed = false;
        self.tip.supervisor.lock().acknowledge();
        let press = error.press;
        let found = self.tip.find();
        found.map_err(|cause| self.abandoned(press, cause))
    }
}
