//! Search for contact: moves down in steps until the force exceeds a threshold.
//!
//! Contact is detected up to one step below the depth at which the force reaches the threshold. Noise may also cause an early detection. Depth zero
//! of the rig therefore differs from the surface, and no sensor can measure this offset.

use crate::parameters::Search;
use crate::random::Stream;

/// Contact detected at a point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Touch {
    /// Depth of the ball below first touch at detection; negative if noise triggered it too early.
    pub late_mm: f64,
    /// Number of readings.
    pub steps: u32,
}

/// Maximum number of steps of a search.
const STEPS_MAX: u32 = 200;

/// Searches for contact from a random start up to one step above the surface. `force_n` gives the true force at a depth, and `error_n` the error of
/// the transducer at a step.
pub(crate) fn search(
    search: &Search,
    phase: Stream,
    error_n: impl Fn(u32) -> f64,
    force_n: impl Fn(f64) -> f64,
) -> Touch {
    let start = -search.step_mm * phase.uniform(0);
    for step in 0..STEPS_MAX {
        let depth = start + f64::from(step) * search.step_mm;
        let force = if depth > 0.0 { force_n(depth) } else { 0.0 };
        if force + error_n(step) > search.threshold_n {
            return Touch {
                late_mm: depth,
                steps: step + 1,
            };
        }
    }
    Touch {
        late_mm: start + f64::from(STEPS_MAX) * search.step_mm,
        steps: STEPS_MAX,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Purpose, Random};

    const STEPS: Search = Search {
        step_mm: 0.1,
        threshold_n: 0.02,
    };

    #[test]
    fn without_noise_contact_is_found_within_a_step_below_the_threshold() {
        let random = Random::new(5);
        for point in 0..1000 {
            let phase = random.stream(Purpose::SearchPhase, point);
            let touch = search(&STEPS, phase, |_| 0.0, |depth| 0.1 * depth);
            assert!((0.2..=0.3 + 1e-12).contains(&touch.late_mm), "{touch:?}");
        }
    }

    #[test]
    fn noise_beyond_the_threshold_calls_contact_in_the_air() {
        let phase = Random::new(5).stream(Purpose::SearchPhase, 1);
        let touch = search(&STEPS, phase, |_| 0.03, |_| 0.0);
        assert!(touch.late_mm < 0.0 && touch.steps == 1);
    }

    #[test]
    fn a_gel_that_never_answers_ends_the_search() {
        let phase = Random::new(5).stream(Purpose::SearchPhase, 1);
        assert_eq!(search(&STEPS, phase, |_| 0.0, |_| 0.0).steps, STEPS_MAX);
    }
}
