//! Manual steps before a press. The robot is halted while the operator is asked.

use taceva_core::Fault;

use super::error::{RunError, StopCause};
use super::event::Event;
use super::operator::{Answer, Question};
use super::session::Run;
use super::tip::Step;
use crate::plan::PlannedPress;

impl Run<'_> {
    /// Mounts the specimen and sets the light of a press, by a changer or the operator. Returns true if the operator skipped a step.
    pub(super) fn is_skipped(&mut self, planned: &PlannedPress) -> Result<bool, RunError> {
        let failed = |run: &mut Self, cause| run.abandoned(Some(planned.id), cause);
        if self.needs_what_was_skipped(planned) {
            return Ok(true);
        }
        self.ask_to_go_on(planned)?;
        let unchanged = self.change(planned)?;
        if self.needs_what_was_skipped(planned) {
            return Ok(true);
        }
        for question in self.needed_by_hand(planned) {
            let (asked, question) = match (&unchanged, question) {
                (Some(why), mount @ Question::Mount(_)) => {
                    let of_changer = Box::new(mount.clone());
                    let why = why.clone();
                    (Question::Instead { of_changer, why }, mount)
                }
                (_, question) => (question.clone(), question),
            };
            match self.ask(&asked) {
                Ok(Answer::Done) => self.done_by_hand(&question),
                Ok(Answer::Skip) => {
                    self.skipped.push(question);
                    self.is_reach_unknown = true;
                    return Ok(true);
                }
                Ok(Answer::Stop) => return Err(failed(self, StopCause::Cancelled)),
                Err(cause) => return Err(failed(self, cause)),
            }
        }
        Ok(false)
    }

    fn needs_what_was_skipped(&mut self, planned: &PlannedPress) -> bool {
        let needed = self.needed_by_hand(planned);
        needed
            .iter()
            .any(|question| self.skipped.contains(question))
    }

    /// Asks the operator after a skipped step whether the robot may move. Until the answer, hands may be within reach, so the robot remains halted.
    fn ask_to_go_on(&mut self, planned: &PlannedPress) -> Result<(), RunError> {
        let specimen = planned.press.specimen;
        let is_changed = self.mounted != Some(specimen) && self.is_held_by_changer(specimen);
        if !self.is_reach_unknown || !is_changed && !self.needed_by_hand(planned).is_empty() {
            return Ok(());
        }
        match self.ask(&Question::GoOn) {
            Ok(Answer::Done) => Ok(()),
            Ok(Answer::Skip | Answer::Stop) => {
                Err(self.abandoned(Some(planned.id), StopCause::Cancelled))
            }
            Err(cause) => Err(self.abandoned(Some(planned.id), cause)),
        }
    }

    /// Manual steps needed before `planned`; empty without an operator.
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
        if !self.is_held_by_changer(press.specimen) && self.mounted != Some(press.specimen) {
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
            Question::Mount(specimen) => self.has_mounted(*specimen),
            Question::Light(light) => {
                self.lit = Some(light.clone());
                (self.events)(&Event::Lit(light.clone()));
            }
            _ => {}
        }
    }

    /// Asks the operator while the robot is halted at or above the travel height. Releases the robot only if the operator confirms that hands are out
    /// of reach.
    pub(super) fn ask(&mut self, question: &Question) -> Step<Answer> {
        if self.operator.is_none() {
            return Ok(Answer::Stop);
        }
        self.stand_out_of_the_way()?;
        let Some(operator) = &mut self.operator else {
            return Ok(Answer::Stop);
        };
        let supervisor = &self.tip.supervisor;
        let answer = supervisor.during_question(|| operator.ask(question, self.tip.cancel));
        if answer == Answer::Done {
            // The operator may have moved the tip down by hand. The tip is then raised first.
            self.tip.release()?;
            self.tip.find_pose()?;
            if !self.tip.is_about_high() {
                self.wait_until_held()?;
                self.tip.find()?;
            }
            self.is_reach_unknown = false;
        }
        Ok(answer)
    }

    /// Continues after `fault` of the robot, once the operator has acknowledged it at the robot. The tip then leaves the gel.
    pub(super) fn go_on_after(&mut self, fault: Fault, error: RunError) -> Result<(), RunError> {
        let Some(operator) = &mut self.operator else {
            return Err(error);
        };
        let question = Question::Acknowledge(fault);
        let supervisor = &self.tip.supervisor;
        let answer = supervisor.during_question(|| operator.ask(&question, self.tip.cancel));
        if answer != Answer::Done {
            return Err(error);
        }
        self.tip.robot_failed = false;
        self.tip.supervisor.lock().acknowledge();
        let press = error.press;
        self.hold(press)?;
        let found = self.tip.find();
        found.map_err(|cause| self.abandoned(press, cause))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::operator::Operator;
    use crate::run::rig::{CONTACT_MM, Rig, plan};
    use crate::run::time::Cancel;
    use crate::run::{Controls, Devices, Left, Mode, RunSpec};

    /// Test operator. At each question, records the height of the tip and whether the robot is halted. May move the tip by hand to a height.
    struct Person(Rig, Answer, Vec<(f64, bool)>, Option<f64>);

    impl Operator for Person {
        fn ask(&mut self, _: &Question, _: &Cancel) -> Answer {
            let mut state = self.0.state();
            self.2.push((state.height_mm, state.halted));
            state.height_mm = self.3.unwrap_or(state.height_mm);
            self.1
        }
    }

    #[test]
    fn a_tip_that_is_low_is_raised_before_somebody_is_asked_and_does_not_move_before_a_yes() {
        let by_hand = Some(CONTACT_MM + 0.5);
        for (answer, lowered_mm) in [
            (Answer::Done, None),
            (Answer::Done, by_hand),
            (Answer::Skip, None),
            (Answer::Stop, None),
            (Answer::Stop, by_hand),
        ] {
            // The gel pushes back below the contact height; readings differ.
            let mut rig = Rig::new(CONTACT_MM + 0.5, |question, height_mm| {
                let pressed_mm = (height_mm - CONTACT_MM).max(0.0);
                Some(0.5 * pressed_mm + f64::from(question) * 1e-6)
            });
            let mut plan = plan();
            for press in &mut plan.presses {
                press.frames = false;
            }
            let (mut force, mut clock) = (rig.clone(), rig.clone());
            let mut person = Person(rig.clone(), answer, Vec::new(), lowered_mm);
            let cancel = Cancel::new();
            let spec = RunSpec {
                plan: &plan,
                unit: &plan.presses[0].press.unit,
                mode: Mode::Rehearse {
                    height: taceva_core::Millimetre(0.0),
                },
            };
            let seen = rig.clone();
            let devices = Devices {
                robot: &mut rig,
                force: &mut force,
                sensor: None,
                lighting: None,
                specimens: None,
            };
            let controls = Controls {
                clock: &mut clock,
                cancel: &cancel,
                events: &mut |_| {},
                operator: Some(&mut person),
            };
            let mut run = Run::new(&spec, devices, controls, None).expect("it begins");
            run.tip.release().expect("free");
            run.tip.find_pose().expect("it stands low");
            run.tip.contact_mm = Some(CONTACT_MM);
            let said = run.ask(&Question::Light("S1".to_owned())).expect("asked");
            assert_eq!(said, answer);
            if answer == Answer::Stop {
                // Hands may be at the tip: a stop does not make the robot ready.
                let error = run.abandoned(None, StopCause::Cancelled);
                let is_low = error.left == Left::InPlace;
                assert_eq!(is_low, lowered_mm.is_some(), "{error}");
            }
            drop(run);
            assert_eq!(person.2, [(-2.0, true)]);
            let raised = seen.motions();
            assert!(
                raised.iter().all(|motion| motion.to_mm < motion.from_mm),
                "{raised:?}"
            );
            assert_eq!(seen.state().halted, answer != Answer::Done);
            if answer == Answer::Done {
                assert!(seen.state().height_mm < 1e-9 - 2.0, "it stands low");
            }
        }
    }
}
