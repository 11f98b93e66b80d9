//! Confusion matrices of classes by cluster, and their scores.

mod margins;
mod table;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use crate::classes::margins::PartMargins;
use crate::clusters::ByCluster;
use crate::error::TaskError;
use crate::names::{Names, same};
use crate::score::TaskScore;

/// Counts of true and predicted classes by cluster, from which all scores of classes are computed.
///
/// Samples of one cluster, such as a trajectory, a clip or an object, are not independent. Counts of 0 use no memory. The counts do not depend on the
/// order of samples or merges.
///
/// ```
/// use taceva_tasks::Classes;
/// let mut textile = Classes::new(["corduroy", "denim", "silk"], None)?;
/// textile.push("clip 1", "denim", "denim")?;
/// textile.push("clip 2", "silk", "denim")?;
/// let scores = textile.scores();
/// assert_eq!((scores[0].metric, scores[0].estimate.value), ("class_accuracy", Ok(0.5)));
/// # Ok::<(), taceva_tasks::TaskError>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(try_from = "Stored")]
pub struct Classes {
    names: Names,
    rule: String,
    #[serde(skip_serializing)]
    n: u64,
    clusters: ByCluster<Cells>,
}

/// Deserialized state, not yet validated: counts may contradict the names.
#[derive(Deserialize)]
struct Stored {
    names: Names,
    rule: String,
    clusters: ByCluster<Cells>,
}

impl TryFrom<Stored> for Classes {
    type Error = TaskError;
    fn try_from(stored: Stored) -> Result<Classes, TaskError> {
        let mut n = 0;
        for cells in stored.clusters.values() {
            for (cell, count) in cells {
                stored.names.check(n + 1, "truth", cell.truth)?;
                stored.names.check(n + 1, "prediction", cell.predicted)?;
                if *count == 0 {
                    return Err(TaskError::damaged("a count of 0"));
                }
                n = TaskError::checked_count(n, *count)?;
            }
        }
        Ok(Classes {
            names: stored.names,
            rule: stored.rule,
            n,
            clusters: stored.clusters,
        })
    }
}

/// Number of samples of each pair of true and predicted class.
type Cells = BTreeMap<Cell, u64>;

/// True and predicted class, as positions among the names; in files `truth>predicted`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
struct Cell {
    truth: u32,
    predicted: u32,
}

impl From<Cell> for String {
    fn from(cell: Cell) -> String {
        format!("{}>{}", cell.truth, cell.predicted)
    }
}

impl TryFrom<String> for Cell {
    type Error = TaskError;
    fn try_from(text: String) -> Result<Cell, TaskError> {
        let parsed = text.split_once('>').and_then(|(truth, predicted)| {
            Some(Cell {
                truth: truth.parse().ok()?,
                predicted: predicted.parse().ok()?,
            })
        });
        parsed.ok_or_else(|| TaskError::damaged(format!("the cell \"{text}\"")))
    }
}

/// Number of samples of one class that are predicted as one class.
///
/// ```
/// use taceva_tasks::Classes;
/// let mut grasp = Classes::new(["lost", "held"], None)?;
/// grasp.push("cup", "held", "lost")?;
/// let cells = grasp.confusion();
/// assert_eq!((cells[0].truth, cells[0].predicted, cells[0].count), ("held", "lost", 1));
/// # Ok::<(), taceva_tasks::TaskError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct ConfusionCell<'a> {
    /// True class.
    pub truth: &'a str,
    /// Predicted class.
    pub predicted: &'a str,
    /// Number of samples, above 0.
    pub count: u64,
}

/// Greatest number of classes for which a large batch of samples is counted in a dense table.
const MOST_DENSE: usize = 256;

impl Classes {
    /// State without samples, for the classes `names`. F1, precision, recall and specificity of the task describe the class `positive`.
    ///
    /// # Errors
    /// [`TaskError::TooFewNames`], [`TaskError::SameName`] or [`TaskError::UnknownPositive`].
    pub fn new<N: Into<String>>(
        names: impl IntoIterator<Item = N>,
        positive: Option<&str>,
    ) -> Result<Classes, TaskError> {
        Ok(Classes {
            names: Names::new(names, positive)?,
            rule: String::new(),
            n: 0,
            clusters: ByCluster::default(),
        })
    }

    /// The same state for predictions to which the rule `rule` was applied, such as `threshold 0.4 strict, debounce 3`.
    ///
    /// The definition of each score contains the rule. States with different rules cannot be merged.
    #[must_use]
    pub fn after_rule(self, rule: impl Into<String>) -> Classes {
        Classes {
            rule: rule.into(),
            ..self
        }
    }

    /// Names of the classes, in their order.
    #[must_use]
    pub fn names(&self) -> &[String] {
        self.names.all()
    }

    /// Class that F1, precision and recall describe; `None` without a positive class.
    #[must_use]
    pub fn positive(&self) -> Option<&str> {
        self.names.positive_name()
    }

    /// Number of samples.
    #[must_use]
    pub fn n(&self) -> u64 {
        self.n
    }

    /// Names of the clusters with samples, in order.
    pub fn clusters(&self) -> impl Iterator<Item = &str> {
        self.clusters.names()
    }

    /// Rule that was applied to the predictions; empty without a rule.
    pub(crate) fn rule(&self) -> &str {
        &self.rule
    }

    /// Counts of all clusters except the clusters in `names`.
    pub(crate) fn without_clusters(&self, names: &[&str]) -> Classes {
        let mut left = self.clone();
        left.clusters.remove(names);
        left.n = left.hits_by_cluster().iter().map(|[_, n]| n).sum();
        left
    }

    /// Number of samples with the right class, and number of all samples, of each cluster.
    pub(crate) fn hits_by_cluster(&self) -> Vec<[u64; 2]> {
        let of_cells = |cells: &Cells| -> [u64; 2] {
            let hits = cells
                .iter()
                .filter(|(cell, _)| cell.truth == cell.predicted);
            [hits.map(|(_, count)| count).sum(), cells.values().sum()]
        };
        self.clusters.values().map(of_cells).collect()
    }

    /// Adds a sample of `cluster` by the names of its true and predicted class.
    ///
    /// # Errors
    /// [`TaskError::UnknownClass`] with the nearest name. No sample is added on an error.
    pub fn push(&mut self, cluster: &str, truth: &str, predicted: &str) -> Result<(), TaskError> {
        let row = self.n + 1;
        let cell = Cell {
            truth: self.names.position(row, "truth", truth)?,
            predicted: self.names.position(row, "prediction", predicted)?,
        };
        self.add(cluster, cell, 1);
        Ok(())
    }

    /// Adds the samples of `cluster` by the positions of their true and predicted classes among the names.
    ///
    /// # Errors
    /// [`TaskError::OtherLength`] or [`TaskError::UnknownPosition`]. No sample is added on an error.
    ///
    /// ```
    /// use taceva_tasks::Classes;
    /// let mut slip = Classes::new(["no_slip", "slip"], Some("slip"))?;
    /// slip.push_positions("stroke 1", &[0, 0, 1, 1], &[0, 1, 1, 1])?;
    /// assert_eq!(slip.n(), 4);
    /// assert!(slip.push_positions("stroke 1", &[2], &[0]).is_err());
    /// # Ok::<(), taceva_tasks::TaskError>(())
    /// ```
    pub fn push_positions(
        &mut self,
        cluster: &str,
        truth: &[u32],
        predicted: &[u32],
    ) -> Result<(), TaskError> {
        if truth.len() != predicted.len() {
            return Err(TaskError::OtherLength {
                column: "the prediction",
                have: predicted.len(),
                expected: truth.len(),
            });
        }
        let columns = [("truth", truth), ("prediction", predicted)];
        for (name, column) in columns {
            for (row, position) in (self.n + 1..).zip(column) {
                self.names.check(row, name, *position)?;
            }
        }
        let classes = self.names.len();
        let cells = truth.iter().zip(predicted);
        if classes <= MOST_DENSE && classes * classes <= truth.len() {
            let mut counts = vec![0_u64; classes * classes];
            for (truth, predicted) in cells {
                counts[*truth as usize * classes + *predicted as usize] += 1;
            }
            let mut counts = counts.into_iter();
            for truth in (0_u32..).take(classes) {
                for (predicted, count) in (0_u32..).zip(counts.by_ref().take(classes)) {
                    self.add(cluster, Cell { truth, predicted }, count);
                }
            }
            return Ok(());
        }
        for (truth, predicted) in cells {
            let cell = Cell {
                truth: *truth,
                predicted: *predicted,
            };
            self.add(cluster, cell, 1);
        }
        Ok(())
    }

    fn add(&mut self, cluster: &str, cell: Cell, count: u64) {
        if count > 0 {
            self.n += count;
            *self.clusters.entry(cluster).entry(cell).or_insert(0) += count;
        }
    }

    /// Adds all samples of `other`.
    ///
    /// # Errors
    /// [`TaskError::OtherDefinition`] if names, the positive class or the rule differ.
    pub fn merge(mut self, other: Classes) -> Result<Classes, TaskError> {
        self.names.check_same(&other.names)?;
        let [ours, theirs] = [&self.rule, &other.rule].map(|rule| match rule.as_str() {
            "" => "none".to_owned(),
            rule => rule.to_owned(),
        });
        same("rule", ours, theirs)?;
        self.n += other.n;
        self.clusters.merge(other.clusters, |ours, theirs| {
            for (cell, count) in theirs {
                *ours.entry(cell).or_insert(0) += count;
            }
        });
        Ok(self)
    }

    /// All counts above 0, in the order of the names of the true class, then of the predicted class.
    #[must_use]
    pub fn confusion(&self) -> Vec<ConfusionCell<'_>> {
        let mut all = Cells::new();
        for cells in self.clusters.values() {
            for (cell, count) in cells {
                *all.entry(*cell).or_insert(0) += count;
            }
        }
        let names = self.names.all();
        let cells = all.into_iter().map(|(cell, count)| ConfusionCell {
            truth: &names[cell.truth as usize],
            predicted: &names[cell.predicted as usize],
            count,
        });
        cells.collect()
    }

    /// All scores: the scores of the task, then the scores of each class.
    ///
    /// | metric | variants | constant to beat |
    /// |---|---|---|
    /// | `class_accuracy` | | share of the most frequent class |
    /// | `balanced_accuracy` | | 1 / classes in the truth |
    /// | `f1`, `precision`, `recall`, `specificity` of the positive class | | of `f1`: all positive |
    /// | `f1_macro` | `in_truth`, `all_names`, `weighted`, `class NAME` | best constant |
    /// | `precision`, `recall` | `class NAME` | |
    /// | `kappa`, `mcc` | | 0 |
    #[must_use]
    pub fn scores(&self) -> Vec<TaskScore> {
        let parts = self.clusters.values().map(|cells| {
            let mut margins = PartMargins::default();
            for (cell, count) in cells {
                margins.add(cell.truth, cell.predicted, *count);
            }
            margins
        });
        table::scores(&self.names, &self.rule, &parts.collect::<Vec<_>>())
    }
}
