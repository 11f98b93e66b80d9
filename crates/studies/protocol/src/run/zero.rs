//! Zero of the force. The transducer sets it. On a real rig, the host computes it as the mean of readings in the air.

use taceva_core::{Newton, NewtonMillimetre, Wrench};

use super::error::StopCause;
use super::force_zero::ForceZero;
use super::supervisor::MotionStage;
use super::tip::{ANY_FORCE, DEADLINE, Step, Tip};

/// Time over which the zero of the force is averaged, in s. A zero command of an amplifier would take seconds at every press.
const LISTEN_S: f64 = 0.25;
/// Time over which the force is averaged for the comparison after a press, in s. A change is measured again over [`LISTEN_S`], because a low-pass
/// filter may still pass force of the gel.
const COMPARE_S: f64 = 0.05;
/// Least number of readings in a mean. It applies to slow transducers.
const LEAST_READINGS: u32 = 4;

impl Tip<'_> {
    /// Sets the zero of the force, while the tip is in the air.
    pub(super) fn call_zero(&mut self) -> Step<()> {
        if self.pace.host_zero {
            return self.call_zero_by_host();
        }
        match self.force.tare() {
            Some(tare) => Ok(tare.zero(DEADLINE)?),
            None => Ok(()),
        }
    }

    fn call_zero_by_host(&mut self) -> Step<()> {
        if self.box_zero.is_none() {
            let mut box_zero = Wrench::default();
            if self.force.tare().is_some() {
                self.watch(ANY_FORCE);
                box_zero = self.mean_force(LISTEN_S)?;
            }
            self.watch(MotionStage::Zeroing);
            if let Some(tare) = self.force.tare() {
                tare.zero(DEADLINE)?;
            }
            self.box_zero = Some(box_zero);
            self.supervisor.lock().call_zero(Wrench::default());
        }
        self.watch(ANY_FORCE);
        let zero = self.mean_force(LISTEN_S)?;
        self.supervisor.lock().call_zero(zero);
        self.is_zero_known = true;
        Ok(())
    }

    /// Force of the transducer without contact, relative to the zero that it had before the run.
    pub(super) fn raw_zero(&self) -> Wrench {
        let own = self.box_zero.unwrap_or_default();
        let by_host = self.supervisor.lock().zero();
        let mut both = Sum::default();
        both.add(&own);
        both.add(&by_host);
        both.mean(1)
    }

    /// Compares the zero of the force after a press with the zero before it. The tip rests in the air. `None` if the transducer sets its own zero.
    pub(super) fn compare_zero(&mut self) -> Step<Option<ForceZero>> {
        if !self.pace.host_zero {
            return Ok(None);
        }
        self.watch(ANY_FORCE);
        let before = self.supervisor.lock().zero();
        let limit_n = self.pace.zero_step_n;
        let mut zero = self.zero_since(&before, COMPARE_S)?;
        if zero.step(limit_n).is_some() {
            zero = self.zero_since(&before, LISTEN_S)?;
        }
        match zero.step(limit_n) {
            None => Ok(Some(zero)),
            Some(step) => {
                // This zero must not detect collisions in the next motion through the air.
                self.is_zero_known = false;
                Err(StopCause::ZeroStep(Box::new(step)))
            }
        }
    }

    fn zero_since(&mut self, before: &Wrench, listen_s: f64) -> Step<ForceZero> {
        let after = self.mean_force(listen_s)?;
        Ok(ForceZero::new(self.clock.now_s(), before, &after))
    }

    /// Mean of the force readings that arrive within `listen_s` seconds, before a zero is subtracted.
    fn mean_force(&mut self, listen_s: f64) -> Step<Wrench> {
        let until_s = self.clock.now_s() + listen_s;
        let (mut sum, mut count) = (Sum::default(), 0_u32);
        while count < LEAST_READINGS || self.clock.now_s() < until_s {
            sum.add(&self.read_force()?.said);
            count += 1;
        }
        Ok(sum.mean(count))
    }
}

/// Sums of forces in N and of torques in N·mm.
#[derive(Default)]
struct Sum([f64; 3], [f64; 3]);

impl Sum {
    fn add(&mut self, wrench: &Wrench) {
        for axis in 0..3 {
            self.0[axis] += wrench.force[axis].0;
            self.1[axis] += wrench.torque[axis].0;
        }
    }

    fn mean(&self, count: u32) -> Wrench {
        let count = f64::from(count);
        Wrench {
            force: self.0.map(|sum| Newton(sum / count)),
            torque: self.1.map(|sum| NewtonMillimetre(sum / count)),
        }
    }
}

#[cfg(test)]
mod tests {
    use taceva_core::Nanometre;

    use crate::run::one_press::OnePress;
    use crate::run::rig::{CONTACT_MM, Rig, plan, with_tip};
    use crate::run::tip::ANY_FORCE;
    use crate::run::{Event, StopCause};

    #[test]
    fn the_host_calls_the_mean_of_a_quarter_of_a_second_zero() {
        // A load of 0.5 N rests on the transducer, with an alternating error of 1 mN.
        let rig = Rig::new(-3.0, |question, _| {
            Some(0.5 + 0.001 * f64::from(question % 2) + f64::from(question) * 1e-9)
        });
        let before_s = rig.state().now_s;
        let force_n = with_tip(&rig, |tip| {
            tip.pace.host_zero = true;
            tip.find_pose()?;
            tip.watch(ANY_FORCE);
            tip.call_zero()?;
            Ok::<f64, crate::StopCause>(tip.look()?.wrench.force[2].0)
        });
        let force_n = force_n.expect("it rests");
        assert!(force_n.abs() < 0.000_6, "{force_n} N");
        // One reading takes a millisecond.
        let listened_s = rig.state().now_s - before_s;
        assert!((0.25..0.26).contains(&listened_s), "{listened_s} s");
    }

    #[test]
    fn the_zero_of_a_session_is_the_force_before_the_transducer_set_its_own_zero() {
        let rig = Rig::new(-3.0, |question, _| Some(1.2 + f64::from(question) * 1e-9));
        rig.state().box_zero_n = Some(0.0);
        let zeroed = with_tip(&rig, |tip| {
            tip.pace.host_zero = true;
            tip.find_pose()?;
            tip.call_zero()?;
            let raw_n = tip.raw_zero().force[2].0;
            Ok::<_, crate::StopCause>((raw_n, tip.look()?.wrench.force[2].0))
        });
        let (raw_n, force_n) = zeroed.expect("it rests");
        assert!((raw_n - 1.2).abs() < 1e-5, "{raw_n} N");
        assert!(force_n.abs() < 1e-5, "{force_n} N");
        let box_zero_n = rig.state().box_zero_n.expect("it sets its own zero");
        assert!((box_zero_n - 1.2).abs() < 1e-5, "{box_zero_n} N");
    }

    #[test]
    fn without_an_own_zero_a_simulated_transducer_stays_as_it_is() {
        let rig = Rig::new(-3.0, |question, _| Some(0.5 + f64::from(question) * 1e-9));
        let force_n = with_tip(&rig, |tip| {
            tip.find_pose()?;
            tip.watch(ANY_FORCE);
            tip.call_zero()?;
            Ok::<f64, crate::StopCause>(tip.look()?.wrench.force[2].0)
        });
        assert!(force_n.expect("it rests") > 0.4);
    }

    /// Force in N of a gel of 1 N/mm at a given height. The zero changes by `step_n` in each of the first `steps` presses.
    fn stepping(step_n: f64, steps: u32) -> impl FnMut(u32, f64) -> Option<f64> {
        let (mut zero_n, mut left, mut is_deep) = (0.0, steps, false);
        move |question, height_mm| {
            let depth_mm = height_mm - CONTACT_MM;
            if depth_mm > 0.25 && !is_deep && left > 0 {
                zero_n += step_n;
                left -= 1;
            }
            is_deep = depth_mm > 0.25;
            Some(zero_n + depth_mm.max(0.0) + f64::from(question) * 1e-9)
        }
    }

    /// Runs one press of 0.5 mm depth on a gel whose zero changes as in `stepping`. Returns the press, and the number of discarded attempts.
    fn pressed(step_n: f64, steps: u32) -> (OnePress, u32) {
        let depth = Nanometre(500_000);
        let press = OnePress::to(depth, stepping(step_n, steps), |plan| {
            plan.limits.as_mut().expect("it moves").signals.host_zero = true;
        });
        let stepped = press.count(|event| matches!(event, Event::ZeroStepped(_)));
        (press, stepped)
    }

    #[test]
    fn a_zero_that_drifts_within_its_limit_is_recorded_with_the_press() {
        let (OnePress { log, done, .. }, stepped) = pressed(0.05, 1);
        let report = done.expect("it drifts slowly");
        assert_eq!((report.made, report.redone, stepped), (1, 0, 0));
        let zero = log.records[0].force_zero.expect("the host computes it");
        assert!((zero.after[2].0 - zero.before[2].0 - 0.05).abs() < 1e-5);
        assert!(log.steps.is_empty());
    }

    #[test]
    fn a_press_in_which_the_zero_steps_is_made_again_and_the_run_goes_on() {
        let (OnePress { log, done, .. }, stepped) = pressed(0.3, 1);
        let report = done.expect("it steps once");
        assert_eq!((report.made, report.redone, stepped), (1, 1, 1));
        let [step] = log.steps[..] else {
            panic!("{:?}", log.steps);
        };
        assert!((step.after[2].0 - 0.3).abs() < 1e-5, "{step:?}");
        let kept = log.records[0].force_zero.expect("the host computes it");
        assert!((kept.before[2].0 - 0.3).abs() < 1e-5, "{kept:?}");
        // The labels of the second attempt are relative to the new zero.
        let position = plan().channels.iter().position(|name| name == "Fz");
        let truth = &log.records[0].samples[0].truth;
        let label_n = truth.get(position.expect("Fz is measured"));
        assert!(label_n.is_some_and(|force_n| (0.5..0.65).contains(&force_n)));
    }

    #[test]
    fn a_zero_that_steps_in_three_attempts_at_a_press_ends_the_run_above_the_gel() {
        let (OnePress { log, done, .. }, stepped) = pressed(0.3, 3);
        let error = done.expect_err("it never holds");
        assert!(matches!(error.cause, StopCause::ZeroStep(_)), "{error}");
        assert_eq!(error.left, crate::run::Left::Clear);
        assert_eq!((log.records.len(), log.steps.len(), stepped), (0, 3, 3));
        let said = error.to_string();
        assert!(said.contains("zero of Fz changed from 0.6"), "{said}");
    }
}
