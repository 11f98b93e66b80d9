//! Rules that convert scores to labels of events.

use serde::{Deserialize, Serialize};

use super::error::EventError;
use crate::error::TaskError;

/// Rule of a task of events: threshold, debounce, tolerance of onsets.
///
/// The default is a threshold of 0.5, no debounce, and a tolerance of 0.2 s. Definitions of scores contain all three. States with different rules
/// cannot be merged.
///
/// ```
/// use taceva_tasks::events::EventRule;
/// let rule = EventRule::default().with_threshold(0.4)?.with_debounce(3)?;
/// assert_eq!(rule.labels(&[0.5, 0.5, 0.41, 0.4]), [false, false, true, false]);
/// assert_eq!(rule.words(), "threshold 0.4 strict, debounce 3, tolerance 0.2 s");
/// # Ok::<(), taceva_tasks::events::EventError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored")]
pub struct EventRule {
    threshold: f64,
    debounce: u32,
    tolerance_s: f64,
}

/// Deserialized rule, not yet validated: numbers may be out of range.
#[derive(Deserialize)]
struct Stored {
    threshold: f64,
    debounce: u32,
    tolerance_s: f64,
}

impl TryFrom<Stored> for EventRule {
    type Error = EventError;
    fn try_from(stored: Stored) -> Result<EventRule, EventError> {
        let rule = EventRule::default().with_threshold(stored.threshold)?;
        let rule = rule.with_debounce(stored.debounce)?;
        rule.with_tolerance_s(stored.tolerance_s)
    }
}

impl Default for EventRule {
    fn default() -> EventRule {
        EventRule {
            threshold: 0.5,
            debounce: 1,
            tolerance_s: 0.2,
        }
    }
}

impl EventRule {
    /// The same rule with an event in frames whose score is above `threshold`.
    ///
    /// # Errors
    /// [`EventError::Threshold`] unless the threshold is finite.
    pub fn with_threshold(self, threshold: f64) -> Result<EventRule, EventError> {
        match threshold.is_finite() {
            true => Ok(EventRule { threshold, ..self }),
            false => Err(EventError::Threshold(threshold)),
        }
    }

    /// The same rule with an event from the `debounce`-th consecutive frame above the threshold.
    ///
    /// # Errors
    /// [`EventError::Debounce`] for 0.
    pub fn with_debounce(self, debounce: u32) -> Result<EventRule, EventError> {
        match debounce {
            0 => Err(EventError::Debounce),
            _ => Ok(EventRule { debounce, ..self }),
        }
    }

    /// The same rule with onsets that match within ± `tolerance_s`.
    ///
    /// # Errors
    /// [`EventError::Tolerance`] unless the tolerance is from 0 to 1e6 s.
    pub fn with_tolerance_s(self, tolerance_s: f64) -> Result<EventRule, EventError> {
        match (0.0..=1e6).contains(&tolerance_s) {
            true => Ok(EventRule {
                tolerance_s,
                ..self
            }),
            false => Err(EventError::Tolerance(tolerance_s)),
        }
    }

    /// Tolerance of onsets, s.
    #[must_use]
    pub fn tolerance_s(self) -> f64 {
        self.tolerance_s
    }

    /// Labels of one sequence: true from the `debounce`-th consecutive frame with a score above the threshold.
    #[must_use]
    pub fn labels(self, scores: &[f64]) -> Vec<bool> {
        let mut run = 0_u32;
        let label = |score: &f64| {
            run = match *score > self.threshold {
                true => run.saturating_add(1),
                false => 0,
            };
            run >= self.debounce
        };
        scores.iter().map(label).collect()
    }

    /// The rule in words.
    #[must_use]
    pub fn words(self) -> String {
        format!(
            "threshold {} strict, debounce {}, tolerance {} s",
            self.threshold, self.debounce, self.tolerance_s
        )
    }

    /// Checks that `other` is the same rule.
    pub(super) fn check_same(self, other: EventRule) -> Result<(), TaskError> {
        if self == other {
            return Ok(());
        }
        Err(TaskError::OtherDefinition {
            what: "event rules",
            ours: self.words(),
            theirs: other.words(),
        })
    }
}
