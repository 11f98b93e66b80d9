//! Task of a model in its card.

use serde::{Deserialize, Serialize};

/// Task whose labels a model predicts: indices of class names, or the numbers of a pose.
///
/// ```
/// let text = r#"{"name": "slip", "kind": "event", "names": ["no", "yes"], "positive": "yes", "cluster": "stroke"}"#;
/// let task: taceva_models::TaskCard = serde_json::from_str(text)?;
/// assert_eq!(task.class(1.0), Some("yes"));
/// assert_eq!(task.class(0.5), None);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct TaskCard {
    /// Name of the task. The predicted channel of classes has this name.
    pub name: String,
    /// Kind of the task: `class`, `event`, `outcome` or `pose`.
    pub kind: String,
    /// Names of the classes, in the order of their positions; empty for poses.
    pub names: Vec<String>,
    /// Class that the model should find, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub positive: Option<String>,
    /// Column with equal values in samples that resemble each other. Windows of frames end where the value changes.
    pub cluster: String,
}

impl TaskCard {
    /// Names of the classes for a reader; the kind of a task without classes.
    pub fn labels(&self) -> String {
        match self.names.is_empty() {
            true => self.kind.clone(),
            false => self.names.join(", "),
        }
    }

    /// Name of the class at `position`; `None` for a number that is not a position.
    pub fn class(&self, position: f64) -> Option<&str> {
        let mut places = (0_u32..).zip(&self.names);
        let found = places.find(|(place, _)| (f64::from(*place) - position).abs() < 1e-6);
        found.map(|(_, name)| name.as_str())
    }
}
