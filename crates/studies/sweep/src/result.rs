//! What a task found: its scores and the errors behind them, in a sealed file.

mod kept;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use taceva_metrics::ClusterSums;
use taceva_report::{Interval, Study, Value};

use crate::key::TaskKey;

/// The schema of a result.
const SCHEMA: &str = "taceva.sweep-result/1.1";

/// Of each channel: contact point, samples of it, and the sum of their absolute errors.
pub(crate) type PointErrors = BTreeMap<String, Vec<(String, u64, f64)>>;

/// What a task found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct TaskResult {
    pub(crate) schema: String,
    /// The task.
    pub(crate) key: TaskKey,
    /// The version of TacEva.
    pub(crate) taceva: String,
    /// Where the samples come from: `recorded`, `simulated`, `synthetic`.
    pub(crate) source: String,
    /// The sensor model, and the serial number of the unit.
    pub(crate) sensor: String,
    pub(crate) serial: String,
    /// The digest of the fitted model.
    pub(crate) model_digest: String,
    /// What settings were chosen by: `validation`, …; never the test part.
    pub(crate) chosen_by: String,
    /// The root mean square error of each channel there.
    pub(crate) validation: Vec<ValidationError>,
    /// The scores on the test part.
    pub(crate) scores: Vec<SweepScore>,
    /// The errors on the test part, by contact point.
    pub(crate) errors: PointErrors,
    /// The digest of the file of its evaluation.
    pub(crate) evaluation: String,
}

/// The error of a channel on the part that settings were chosen on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct ValidationError {
    pub(crate) channel: String,
    pub(crate) unit: String,
    pub(crate) rmse: f64,
}

/// One score on the test part.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct SweepScore {
    pub(crate) metric: String,
    pub(crate) channel: String,
    pub(crate) unit: String,
    pub(crate) better: String,
    /// The value; absent where there is none, for the reason.
    pub(crate) value: Option<f64>,
    pub(crate) reason: Option<String>,
    /// The interval of 95 % by contact point.
    pub(crate) interval: Option<[f64; 2]>,
    pub(crate) n: u64,
}

impl TaskResult {
    /// An empty result of `key`.
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

    /// With what an evaluation says: numbers, and reasons where there is none; maps and curves stand in the evaluation alone.
    pub(crate) fn with_scores(mut self, study: &Study) -> TaskResult {
        self.source.clone_from(&study.source);
        self.sensor.clone_from(&study.sensor);
        self.serial.clone_from(&study.serial);
        for score in &study.scores {
            let (value, reason) = match &score.value {
                Value::Number(value) => (Some(*value), None),
                Value::Undefined(why) => (None, Some(format!("undefined: {why}"))),
                Value::NotApplicable(why) => (None, Some(format!("not applicable: {why}"))),
                Value::Map(_) | Value::Curve(_) | Value::Matrix(_) => continue,
            };
            let interval = match &score.interval {
                Some(Interval::Ends { ends, .. }) => Some(*ends),
                Some(Interval::Absent(_)) | None => None,
            };
            self.scores.push(SweepScore {
                metric: score.metric.clone(),
                channel: score.channel.clone(),
                unit: score.unit.symbol().to_owned(),
                better: score.better().name().to_owned(),
                value,
                reason,
                interval,
                n: score.n,
            });
        }
        self
    }

    /// The score of a metric and channel.
    pub(crate) fn score(&self, metric: &str, channel: &str) -> Option<&SweepScore> {
        let mut scores = self.scores.iter();
        scores.find(|score| score.metric == metric && score.channel == channel)
    }

    /// The absolute errors of a channel by contact point.
    pub(crate) fn sums(&self, channel: &str) -> Option<ClusterSums> {
        let mut sums = ClusterSums::default();
        for (point, n, sum) in self.errors.get(channel)? {
            sums.try_add(point, *sum).ok()?;
            // The sum of a point counts for all of its samples.
            for _ in 1..*n {
                sums.try_add(point, 0.0).ok()?;
            }
        }
        Some(sums)
    }
}
