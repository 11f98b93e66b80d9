//! What a task found: its scores and the errors behind them, in a sealed file.

use std::collections::BTreeMap;
use std::fs;

use serde::{Deserialize, Serialize};
use taceva_metrics::ClusterSums;
use taceva_report::{Interval, Study, Value};
use taceva_seal::Version;

use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::key::TaskKey;

/// The schema of a result.
const SCHEMA: &str = "taceva.sweep-result/1.0";

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

    pub(crate) fn text(&self) -> Result<String, SweepError> {
        let text =
            serde_json::to_string(self).map_err(|error| self.unwritable(error.to_string()))?;
        let text = taceva_seal::json::seal(&text);
        text.map_err(|error| self.unwritable(error.to_string()))
    }

    fn unwritable(&self, problem: String) -> SweepError {
        SweepError::Kept {
            path: format!("results/{}.json", self.key).into(),
            problem,
        }
    }

    /// The result of `key` in `folder`; `None` if there is none.
    pub(crate) fn read(
        folder: &SweepFolder,
        key: &TaskKey,
    ) -> Result<Option<TaskResult>, SweepError> {
        let path = folder.result(key);
        let text = match fs::read_to_string(&path) {
            Ok(text) => text,
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(None),
            Err(error) => return Err(SweepError::io("read", &path)(error)),
        };
        let wrong = |problem: String| SweepError::Kept {
            path: path.clone(),
            problem: format!("{problem}; remove the file, and the task is carried out again"),
        };
        taceva_seal::json::check(&text, Version::Sealed)
            .map_err(|error| wrong(error.to_string()))?;
        let result: TaskResult =
            serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))?;
        if result.schema != SCHEMA {
            return Err(wrong(format!(
                "schema `{}`, expected `{SCHEMA}`",
                result.schema
            )));
        }
        if result.taceva != env!("CARGO_PKG_VERSION") {
            return Err(wrong(format!(
                "a result of TacEva {}, this is {}",
                result.taceva,
                env!("CARGO_PKG_VERSION")
            )));
        }
        if &result.key != key {
            return Err(wrong(format!("the result of the task {}", result.key)));
        }
        Ok(Some(result))
    }
}
