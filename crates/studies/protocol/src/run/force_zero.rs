//! Zero of the transducer before and after a press, and its change.

use std::fmt;

use taceva_core::{Newton, Wrench};

/// Names of the force components in messages.
const COMPONENTS: [&str; 3] = ["Fx", "Fy", "Fz"];

/// Force in the air that the transducer reports before and after a press, in N in the frame of the sensor.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ForceZero {
    /// Time of the measurement after the press, in s, on the clock of the samples.
    pub at_s: f64,
    /// Force in the air before the press.
    pub before: [Newton; 3],
    /// Force in the air after the press.
    pub after: [Newton; 3],
}

/// Change of the zero of the force during a press, beyond its limit. The forces of the press are uncertain by this change.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct ZeroStep {
    /// The zero before and after the press.
    pub zero: ForceZero,
    /// Greatest allowed change of each force component, in N.
    pub limit_n: f64,
}

impl ForceZero {
    pub(super) fn new(at_s: f64, before: &Wrench, after: &Wrench) -> ForceZero {
        ForceZero {
            at_s,
            before: before.force,
            after: after.force,
        }
    }

    /// Returns the fault if a force component changed by more than `limit_n`. NaN counts as a change.
    pub(super) fn step(self, limit_n: f64) -> Option<ZeroStep> {
        let is_same = |axis: usize| self.change_n(axis).abs() <= limit_n;
        let step = ZeroStep {
            zero: self,
            limit_n,
        };
        (!(0..3).all(is_same)).then_some(step)
    }

    fn change_n(&self, axis: usize) -> f64 {
        self.after[axis].0 - self.before[axis].0
    }

    /// Index of the force component that changed most.
    fn changed(&self) -> usize {
        let size = |axis: usize| self.change_n(axis).abs();
        (0..3).fold(0, |most, axis| match size(axis) > size(most) {
            true => axis,
            false => most,
        })
    }
}

impl fmt::Display for ZeroStep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let axis = self.zero.changed();
        write!(
            f,
            "during the press the zero of {} changed from {:.4} N to {:.4} N, expected a change of at most {:.4} N (`zero_step_max_N` of [force] in the rig file). Let the transducer warm up, check its cable and mounting, and continue with `--resume`",
            COMPONENTS[axis], self.zero.before[axis].0, self.zero.after[axis].0, self.limit_n
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_zero_that_moved_beyond_its_limit_names_the_component_both_values_and_the_key() {
        let wrench = |force: [f64; 3]| Wrench {
            force: force.map(Newton),
            ..Wrench::default()
        };
        let zero = |after| ForceZero::new(1.0, &wrench([0.1, 0.2, 7.5]), &wrench(after));
        assert_eq!(zero([0.12, 0.18, 7.52]).step(0.05), None);
        let step = zero([0.12, 0.1, 7.52]).step(0.05).expect("Fy moved");
        let said = step.to_string();
        assert!(
            said.contains("zero of Fy changed from 0.2000 N to 0.1000 N")
                && said.contains("at most 0.0500 N (`zero_step_max_N`"),
            "{said}"
        );
        assert!(zero([0.1, 0.2, f64::NAN]).step(0.05).is_some());
    }
}
