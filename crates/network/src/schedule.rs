//! Learning rate of each step.

use serde::{Deserialize, Serialize};

/// Learning rate over the course of a training.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Schedule {
    /// Constant rate.
    Constant,
    /// Rate that falls from the full rate to zero along half a cosine.
    Cosine,
    /// Rate multiplied by `factor` after every `every` steps.
    Step {
        /// Number of steps between changes.
        every: u64,
        /// Factor of each change.
        factor: f64,
    },
    /// Rate that rises from 1/25 of the full rate along half a cosine for the share `rise` of all steps. Then the rate falls to 1/10,000 of its start
    /// value over the remaining steps.
    ///
    /// # Reference
    /// L. N. Smith, N. Topin, "Super-convergence", 2019. Limits and shape follow PyTorch's `OneCycleLR`.
    OneCycle {
        /// Share of steps with a rising rate, above 0 and below 1.
        rise: f64,
    },
}

impl Schedule {
    /// Ratio of the learning rate to the full rate at step `step` of `steps`, counted from 0.
    ///
    /// ```
    /// use taceva_network::Schedule;
    /// assert_eq!(Schedule::Cosine.factor(0, 100), 1.0);
    /// assert!((Schedule::Cosine.factor(50, 100) - 0.5).abs() < 1e-12);
    /// assert_eq!(Schedule::Step { every: 10, factor: 0.1 }.factor(19, 100), 0.1);
    /// ```
    pub fn factor(self, step: u64, steps: u64) -> f64 {
        let between = |from: f64, to: f64, share: f64| {
            to + (from - to) * 0.5 * (1.0 + (std::f64::consts::PI * share).cos())
        };
        match self {
            Schedule::Constant => 1.0,
            Schedule::Cosine => between(1.0, 0.0, step as f64 / steps.max(1) as f64),
            Schedule::Step { every, factor } => {
                let changes = i32::try_from(step / every.max(1)).unwrap_or(i32::MAX);
                factor.powi(changes)
            }
            Schedule::OneCycle { rise } => {
                let (start, end) = (1.0 / 25.0, 1.0 / 250_000.0);
                let peak = rise * steps as f64 - 1.0;
                let (step, last) = (step as f64, steps as f64 - 1.0);
                if step <= peak {
                    between(start, 1.0, step / peak)
                } else {
                    between(1.0, end, (step - peak) / (last - peak))
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_cycle_goes_as_pytorch_s() {
        let schedule = Schedule::OneCycle { rise: 0.3 };
        let close = |step, expected: f64| {
            let found = schedule.factor(step, 100);
            assert!((found - expected).abs() < 1e-9, "{step}: {found}");
        };
        // torch.optim.lr_scheduler.OneCycleLR(max_lr=1, total_steps=100).
        close(0, 0.04);
        close(29, 1.0);
        close(99, 4e-6);
    }
}
