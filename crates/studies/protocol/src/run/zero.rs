//! Zero of the force. The transducer sets it, or on a real rig it is computed as the mean of readings in the air.

use taceva_core::{Newton, NewtonMillimetre, Wrench};

use super::supervisor::MotionStage;
use super::tip::{ANY_FORCE, DEADLINE, Step, Tip};

/// Averaging time of the zero, in s. A zero command of an amplifier would take seconds at every press.
const LISTEN_S: f64 = 0.25;
/// Least number of readings of a mean, for slow transducers.
const LEAST_READINGS: u32 = 4;

impl Tip<'_> {
    /// Zeroes the force while the tip is in the air.
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
        if !self.is_box_zeroed {
            self.watch(MotionStage::Zeroing);
            if let Some(tare) = self.force.tare() {
                tare.zero(DEADLINE)?;
            }
            self.is_box_zeroed = true;
            self.supervisor.lock().call_zero(Wrench::default());
        }
        self.watch(ANY_FORCE);
        let until_s = self.clock.now_s() + LISTEN_S;
        let (mut sum, mut count) = (Sum::default(), 0_u32);
        while count < LEAST_READINGS || self.clock.now_s() < until_s {
            sum.add(&self.read_force()?.said);
            count += 1;
        }
        self.supervisor.lock().call_zero(sum.mean(count));
        self.is_zero_known = true;
        Ok(())
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
    use crate::run::rig::{Rig, with_tip};
    use crate::run::tip::ANY_FORCE;

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
}
