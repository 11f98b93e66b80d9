//! Result of a task: its scores and the errors of its predictions, in a sealed file.

mod file;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use taceva_core::Unit;
use taceva_metrics::ClusterSums;
use taceva_results::{EvaluationReport, Score, Value, by_metric};

use crate::file::ALL_METRICS;
use crate::key::TaskKey;

const SCHEMA: &str = "taceva.sweep-result/1.0";
/// Variant of a score of labels: the score of the best constant prediction.
pub(crate) const OF_CONSTANT: &str = "of_constant";

/// Errors of each channel: group or contact point, number of its samples, and sum of their absolute errors.
pub(crate) type PointErrors = BTreeMap<String, Vec<(String, u64, f64)>>;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct TaskResult {
    pub(crate) schema: String,
    pub(crate) key: TaskKey,
    /// Version of TacEva that ran the task.
    pub(crate) taceva: String,
    /// Origin of the samples: `recorded`, `simulated`, `synthetic`.
    pub(crate) source: String,
    /// Model of the sensor, and serial number of the unit.
    pub(crate) sensor: String,
    pub(crate) serial: String,
    /// Digest of the fitted model.
    pub(crate) model_digest: String,
    /// Name of the samples on which settings were chosen, such as `validation`; never the test part.
    pub(crate) chosen_by: String,
    /// Root mean square error of each channel on the samples named by `chosen_by`.
    pub(crate) validation: Vec<ValidationError>,
    /// Scores on the test part.
    #[serde(rename = "metrics", with = "by_metric")]
    pub(crate) scores: Vec<Score>,
    /// Errors on the test part, by group or contact point.
    pub(crate) errors: PointErrors,
    /// Digest of the evaluation's file.
    pub(crate) evaluation: String,
}

/// Error of a channel on the samples on which settings were chosen.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct ValidationError {
    pub(crate) channel: String,
    pub(crate) unit: Unit,
    pub(crate) rmse: f64,
}

impl TaskResult {
    /// An empty result of the task with the key `key`.
    pub(crate) fn new(key: TaskKey) -> TaskResult {
        TaskResult {
            schema: SCHEMA.to_owned(),
            key,
            taceva: env!("CARGO_PKG_VERSION").to_owned(),
            source: String::new(),
            sensor: String::new(),
            serial: String::new(),
            model_digest: String::new(),
            chosen_by: String::new(),
            validation: Vec::new(),
            scores: Vec::new(),
            errors: BTreeMap::new(),
            evaluation: String::new(),
        }
    }

    /// Adds the scores of `report` that are single numbers or missing. Maps and curves are stored only in the evaluation.
    pub(crate) fn with_scores(mut self, report: &EvaluationReport) -> TaskResult {
        self.source.clone_from(&report.subject.source);
        self.sensor.clone_from(&report.subject.sensor);
        self.serial.clone_from(&report.subject.serial);
        let scores = report.scores.iter();
        let scores = scores.filter(|score| !score.value.is_of_many());
        self.scores.extend(scores.map(|score| Score {
            variants: Vec::new(),
            ..score.clone()
        }));
        self
    }

    /// Adds the `scores` of the labels called `name` whose metric is among `wanted`, with the score of the best constant. A wanted metric without a
    /// score gets a reason. Scores of single classes are stored only in the evaluation.
    pub(crate) fn add_label_scores(&mut self, name: &str, scores: &[Score], wanted: &[String]) {
        let is_wanted = |score: &&Score| {
            wanted
                .iter()
                .any(|name| *name == score.metric || name == ALL_METRICS)
        };
        let own = scores.iter().filter(is_wanted);
        self.scores.extend(own.map(|score| Score {
            variants: score.variant(OF_CONSTANT).cloned().into_iter().collect(),
            ..score.clone()
        }));
        let known: Vec<&str> = scores.iter().map(|score| score.metric.as_str()).collect();
        for metric in wanted {
            if metric != ALL_METRICS && !known.contains(&metric.as_str()) {
                let reason = format!(
                    "`{name}` has no such score in this table, expected one of {}",
                    known.join(", ")
                );
                self.scores.push(Score {
                    value: Value::NotApplicable(reason),
                    ..Score::of_number(metric, name, 0.0, Unit::One)
                });
            }
        }
    }

    pub(crate) fn score(&self, metric: &str, channel: &str) -> Option<&Score> {
        let mut scores = self.scores.iter();
        scores.find(|score| score.metric == metric && score.channel == channel)
    }

    /// Absolute errors of a channel by group or contact point; `None` if the result has no errors of the channel.
    pub(crate) fn sums(&self, channel: &str) -> Option<ClusterSums> {
        let mut sums = ClusterSums::default();
        for (point, n, sum) in self.errors.get(channel)? {
            sums.try_add(point, *sum).ok()?;
            // Counts the other samples of the point; the sum is already complete.
            for _ in 1..*n {
                sums.try_add(point, 0.0).ok()?;
            }
        }
        Some(sums)
    }
}
