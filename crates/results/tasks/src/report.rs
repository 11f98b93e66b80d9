//! Scores of the tasks of a table, with the definition of each task.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::evidence::TaskEvidence;
use crate::public_number::PublicNumber;
use crate::score::TaskScore;

/// Schema of a report of tasks. Version 1.1 added method, standard error and degrees of freedom of each interval.
pub const TASKS_SCHEMA: &str = "taceva.tasks/1.1";

/// Scores of tasks, from a table of true labels and a table of predictions.
///
/// ```
/// use taceva_tasks::{TASKS_SCHEMA, TaskReport};
/// let report = TaskReport::new("0.2.0", "by `sample`");
/// assert_eq!((report.schema, report.tasks.len()), (TASKS_SCHEMA, 0));
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TaskReport {
    /// Schema of the report.
    pub schema: &'static str,
    /// Version of the program.
    pub taceva: String,
    /// Digests of the tables by their role: `truth`, `prediction`.
    pub tables: BTreeMap<String, String>,
    /// Origins of the samples, such as `recorded` and `simulated`.
    pub sources: Vec<String>,
    /// Pairing of the rows, in words.
    pub paired: String,
    /// The tasks, in the requested order.
    pub tasks: Vec<TaskScores>,
}

impl TaskReport {
    /// Report without tasks by the program version `taceva`. `paired` describes the pairing of rows.
    #[must_use]
    pub fn new(taceva: impl Into<String>, paired: impl Into<String>) -> TaskReport {
        TaskReport {
            schema: TASKS_SCHEMA,
            taceva: taceva.into(),
            tables: BTreeMap::new(),
            sources: Vec::new(),
            paired: paired.into(),
            tasks: Vec::new(),
        }
    }
}

/// Scores of one task.
///
/// ```
/// use taceva_tasks::{Classes, TaskScores};
/// let mut grasp = Classes::new(["lost", "held"], Some("held"))?;
/// grasp.push("cup", "held", "held")?;
/// let scores = TaskScores::new("grasp", "outcome", "object").of_classes(&grasp);
/// assert_eq!((scores.names.len(), scores.confusion[0].count), (2, 1));
/// # Ok::<(), taceva_tasks::TaskError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct TaskScores {
    /// Name of the task.
    pub name: String,
    /// Kind of the task: `class`, `event`, `outcome`, `pose`, `place` or `depth`.
    pub kind: String,
    /// Table column that names the cluster of each row.
    pub cluster: String,
    /// Names of the clusters in order, for paired comparisons. Reports omit these names.
    #[serde(skip)]
    pub clusters: Vec<String>,
    /// Classes in their order; empty for a kind without classes.
    pub names: Vec<String>,
    /// Class that F1, precision and recall describe; `None` without a positive class.
    pub positive: Option<String>,
    /// Remarks on labels and predictions, such as rows without a label.
    pub notes: Vec<String>,
    /// Scores: first of the whole task, then of single classes.
    pub scores: Vec<TaskScore>,
    /// Counts above 0 of true and predicted classes.
    pub confusion: Vec<ConfusionCount>,
    /// Numbers as a public program computes them, if requested.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub as_published: Vec<PublicNumber>,
    /// Content of the task's report page besides its scores.
    #[serde(skip)]
    pub evidence: TaskEvidence,
}

/// Number of samples of one class that are predicted as one class.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct ConfusionCount {
    /// True class.
    pub truth: String,
    /// Predicted class.
    pub predicted: String,
    /// Number of samples, above 0.
    pub count: u64,
}

impl TaskScores {
    /// Task without scores; `cluster` is the column with the clusters.
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        kind: impl Into<String>,
        cluster: impl Into<String>,
    ) -> TaskScores {
        TaskScores {
            name: name.into(),
            kind: kind.into(),
            cluster: cluster.into(),
            clusters: Vec::new(),
            names: Vec::new(),
            positive: None,
            notes: Vec::new(),
            scores: Vec::new(),
            confusion: Vec::new(),
            as_published: Vec::new(),
            evidence: TaskEvidence::default(),
        }
    }

    /// The same task with names, counts and scores of `classes`.
    #[must_use]
    pub fn of_classes(mut self, classes: &crate::Classes) -> TaskScores {
        self.names = classes.names().to_vec();
        self.positive = classes.positive().map(str::to_owned);
        self.scores.extend(classes.scores());
        let cells = classes.confusion().into_iter();
        self.confusion = cells
            .map(|cell| ConfusionCount {
                truth: cell.truth.to_owned(),
                predicted: cell.predicted.to_owned(),
                count: cell.count,
            })
            .collect();
        self
    }
}
