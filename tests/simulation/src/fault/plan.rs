//! Plan of faults. The seed and the number of a call determine whether the call fails.

use std::ops::Range;
use std::sync::Arc;
use std::time::Duration;

use super::draw::draw;
use super::{FaultKind, FaultLog};

/// Faults of one device.
///
/// ```
/// use taceva_simulation::fault::{FaultKind, FaultPlan, Likelihood};
/// let plan = FaultPlan::none()
///     .during(FaultKind::Freeze, 10..20)
///     .drawn(7, FaultKind::Silence, Likelihood { per_thousand: 5, calls: 3 });
/// assert_eq!(plan.at(15), Some(FaultKind::Freeze));
/// assert_eq!(plan.clone().at(99), plan.at(99));
/// ```
#[derive(Clone, Debug)]
pub struct FaultPlan {
    faults: Vec<Fault>,
    delay: Duration,
    log: Arc<FaultLog>,
}

#[derive(Clone, Debug)]
enum Fault {
    During {
        kind: FaultKind,
        calls: Range<u64>,
    },
    Drawn {
        kind: FaultKind,
        seed: u64,
        likelihood: Likelihood,
    },
}

/// Probability and duration of a random fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Likelihood {
    /// Mean number of calls, among 1,000, in which a fault begins.
    pub per_thousand: u32,
    /// Number of calls that a fault lasts.
    pub calls: u32,
}

impl FaultPlan {
    /// Plan without faults.
    pub fn none() -> FaultPlan {
        FaultPlan {
            faults: Vec::new(),
            delay: Duration::from_millis(80),
            log: Arc::new(FaultLog::default()),
        }
    }

    /// The same plan, with `kind` during the calls numbered `calls`, from 0.
    #[must_use]
    pub fn during(mut self, kind: FaultKind, calls: Range<u64>) -> FaultPlan {
        self.faults.push(Fault::During { kind, calls });
        self
    }

    /// The same plan, with `kind` at random, drawn from `seed`.
    #[must_use]
    pub fn drawn(mut self, seed: u64, kind: FaultKind, likelihood: Likelihood) -> FaultPlan {
        self.faults.push(Fault::Drawn {
            kind,
            seed,
            likelihood,
        });
        self
    }

    /// The same plan with another delay of the slow link; 80 ms by default.
    #[must_use]
    pub fn delay(mut self, delay: Duration) -> FaultPlan {
        self.delay = delay;
        self
    }

    /// Fault of call number `call`: the first in the plan if there are several, `None` without a fault.
    pub fn at(&self, call: u64) -> Option<FaultKind> {
        self.faults.iter().find_map(|fault| fault.at(call))
    }

    /// Counts of faults of all devices with this plan or a clone of it.
    pub fn log(&self) -> Arc<FaultLog> {
        Arc::clone(&self.log)
    }

    pub(super) fn note(&self, kind: FaultKind) {
        self.log.note(kind);
    }

    pub(super) fn slow_link(&self) -> Duration {
        self.delay
    }
}

impl Fault {
    fn at(&self, call: u64) -> Option<FaultKind> {
        match self {
            Fault::During { kind, calls } => calls.contains(&call).then_some(*kind),
            Fault::Drawn {
                kind,
                seed,
                likelihood,
            } => {
                let begins = |call| {
                    draw(*seed, *kind as u64, call) % 1_000 < u64::from(likelihood.per_thousand)
                };
                let earliest = call.saturating_sub(u64::from(likelihood.calls.saturating_sub(1)));
                let lasts = likelihood.calls > 0;
                (lasts && (earliest..=call).any(begins)).then_some(*kind)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_drawn_fault_comes_as_often_and_lasts_as_long_as_planned() {
        let likelihood = Likelihood {
            per_thousand: 10,
            calls: 4,
        };
        let plan = FaultPlan::none().drawn(3, FaultKind::Drop, likelihood);
        let active: Vec<bool> = (0..100_000).map(|call| plan.at(call).is_some()).collect();
        // 1 − 0.99⁴ = 3.94 %.
        let share = active.iter().filter(|active| **active).count();
        assert!((3_500..4_400).contains(&share), "{share} of 100,000");
        let begun = active
            .windows(2)
            .position(|pair| !pair[0] && pair[1])
            .expect("some");
        assert!(active[begun + 1..begun + 5].iter().all(|active| *active));
    }

    #[test]
    fn the_same_seed_gives_the_same_faults_in_any_order_of_asking() {
        let likelihood = Likelihood {
            per_thousand: 100,
            calls: 2,
        };
        let plan = |seed| FaultPlan::none().drawn(seed, FaultKind::Freeze, likelihood);
        let forwards: Vec<_> = (0..500).map(|call| plan(1).at(call)).collect();
        let mut backwards: Vec<_> = (0..500).rev().map(|call| plan(1).at(call)).collect();
        backwards.reverse();
        assert_eq!(forwards, backwards);
        let other: Vec<_> = (0..500).map(|call| plan(2).at(call)).collect();
        assert_ne!(forwards, other);
    }
}
