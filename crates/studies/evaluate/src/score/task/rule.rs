//! Rules between predictions and scored classes: a threshold on the score of the positive class, and a debounce.

use std::fmt;

/// Rule that is applied before classes are scored.
///
/// ```
/// use taceva_evaluate::TaskRule;
/// let rule = TaskRule { threshold: Some(0.4), debounce: Some(3) };
/// assert_eq!(rule.to_string(), "threshold 0.4 strict, debounce 3");
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TaskRule {
    /// Threshold above which a score predicts the positive class; `None` predicts the class with the greatest score.
    pub threshold: Option<f64>,
    /// Number of consecutive positive rows of a cluster from which the prediction is positive; `None` for 1.
    pub debounce: Option<u32>,
}

impl TaskRule {
    /// True if the rule changes nothing.
    pub fn is_empty(&self) -> bool {
        *self == TaskRule::default()
    }
}

impl fmt::Display for TaskRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.threshold, self.debounce) {
            (Some(threshold), Some(debounce)) => {
                write!(f, "threshold {threshold} strict, debounce {debounce}")
            }
            (Some(threshold), None) => write!(f, "threshold {threshold} strict"),
            (None, Some(debounce)) => write!(f, "debounce {debounce}"),
            (None, None) => f.write_str("none"),
        }
    }
}
