//! Task of a model: classes or a pose to predict.

use serde::{Deserialize, Serialize};

/// Task of a model. Labels are indices of class names, or the coordinates of a pose.
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
    /// Name of the task. In a task with classes, the predicted channel has this name.
    pub name: String,
    /// Kind of the task: `class`, `event`, `outcome` or `pose`.
    pub kind: String,
    /// Names of the classes. The label of a class is its index in this list. Empty for a pose.
    pub names: Vec<String>,
    /// Class that the model is meant to detect, if any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub positive: Option<String>,
    /// Column whose equal values mark samples that resemble each other, such as the samples of one stroke. A window of successive frames ends where
    /// the value changes.
    pub cluster: String,
}

impl TaskCard {
    /// Names of the classes, separated by commas; the kind of the task if there are no classes.
    pub fn labels(&self) -> String {
        match self.names.is_empty() {
            true => self.kind.clone(),
            false => self.names.join(", "),
        }
    }

    /// Name of the class with index `position`; `None` if `position` is not the index of a class.
    pub fn class(&self, position: f64) -> Option<&str> {
        let mut places = (0_u32..).zip(&self.names);
        let found = places.find(|(place, _)| (f64::from(*place) - position).abs() < 1e-6);
        found.map(|(_, name)| name.as_str())
    }
}
