//! Scores of tasks, such as slip detection, which a study computes in addition to the scores of channels.

use serde::{Deserialize, Serialize};
use serde_json::Value;

/// Scores of one task, as JSON in the schema `taceva.tasks/1.1`.
///
/// ```
/// use taceva_results::StudyTask;
/// let text = r#"{"name": "slip", "notes": ["model lda"], "scores": [{"metric": "f1", "variant": null,
///     "estimate": {"value": 0.9, "ci95": [0.8, 0.95], "n": 440, "clusters": 40, "of_constant": 0.6}}]}"#;
/// let slip: StudyTask = serde_json::from_str(text)?;
/// let scores: Vec<_> = slip.scores().collect();
/// assert_eq!((slip.name(), scores[0].metric, scores[0].value), ("slip", "f1", Some(0.9)));
/// assert_eq!(scores[0].interval, Some([0.8, 0.95]));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct StudyTask(Value);

/// Score of a task, as opposed to a variant of a score.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TaskNumber<'a> {
    /// Name of the metric.
    pub metric: &'a str,
    /// Unit of the value; empty for a pure number.
    pub unit: &'a str,
    /// The score; `None` if it is undefined.
    pub value: Option<f64>,
    /// Interval at 95 % by cluster; `None` without an interval.
    pub interval: Option<[f64; 2]>,
    /// Score of the best constant prediction; `None` if the metric has no such score.
    pub of_constant: Option<f64>,
    /// Number of samples.
    pub n: u64,
    /// Number of clusters.
    pub clusters: u64,
}

impl StudyTask {
    /// Creates the scores of a task from their JSON.
    pub fn new(task: Value) -> StudyTask {
        StudyTask(task)
    }

    /// Name of the task.
    pub fn name(&self) -> &str {
        self.0["name"].as_str().unwrap_or_default()
    }

    /// Remarks on labels and predictions.
    pub fn notes(&self) -> impl Iterator<Item = &str> {
        let notes = self.0["notes"].as_array();
        notes.into_iter().flatten().filter_map(Value::as_str)
    }

    /// Scores of the task as a whole, without variants and without scores of single classes.
    pub fn scores(&self) -> impl Iterator<Item = TaskNumber<'_>> {
        let scores = self.0["scores"].as_array().into_iter().flatten();
        let own = scores.filter(|score| score["variant"].is_null());
        own.map(|score| {
            let estimate = &score["estimate"];
            let count = |key: &str| estimate[key].as_u64().unwrap_or_default();
            let end = |at: usize| estimate["ci95"][at].as_f64();
            TaskNumber {
                metric: score["metric"].as_str().unwrap_or_default(),
                unit: score["unit"].as_str().unwrap_or_default(),
                value: estimate["value"].as_f64(),
                interval: end(0).zip(end(1)).map(|(low, high)| [low, high]),
                of_constant: estimate["of_constant"].as_f64(),
                n: count("n"),
                clusters: count("clusters"),
            }
        })
    }
}
