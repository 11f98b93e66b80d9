//! Evaluation reports.

use serde::{Deserialize, Serialize};
use taceva_core::Skipped;
use taceva_metrics::Evaluation;

use crate::group_errors::GroupErrors;
use crate::provenance::Provenance;
use crate::samples::Samples;
use crate::score::{Score, by_metric, scores};
use crate::seeds::OverSeeds;
use crate::subject::Subject;
use crate::task::StudyTask;

/// Schema of the JSON of one evaluation report.
///
/// Unreleased versions wrote `taceva.evaluation/1` and 1.1 to 1.4. The next schema is 1.5.
pub const EVALUATION_SCHEMA: &str = "taceva.evaluation/1.0";

/// Scores of one sensor, with the description of the sensor and the provenance of the scores.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvaluationReport {
    /// Schema of the report: [`EVALUATION_SCHEMA`].
    pub schema: String,
    /// Evaluated sensor.
    pub subject: Subject,
    /// Scores in the order of the metric catalogue.
    #[serde(rename = "metrics", with = "by_metric")]
    pub scores: Vec<Score>,
    /// Skipped metrics with their reasons.
    #[serde(default)]
    pub skipped: Vec<Skip>,
    /// Inputs and settings behind the scores.
    #[serde(default)]
    pub provenance: Provenance,
    /// Scores of each recording; empty unless several recordings were joined.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub by_recording: Vec<RecordingScores>,
    /// Errors of each group that the split keeps together. Empty unless a column of the dataset names 2 to 20 groups.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub by_group: Vec<GroupErrors>,
    /// Scores of the same model fitted with further training seeds; `None` if not requested.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub over_seeds: Option<OverSeeds>,
    /// Scores of tasks, such as slip; empty unless the scene requests a task.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub tasks: Vec<StudyTask>,
    /// Table of the samples behind the scores; `None` without a table. The JSON does not contain this table.
    #[serde(skip)]
    pub samples: Option<Samples>,
}

/// Scores from the samples of one of several recordings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordingScores {
    /// Name of the recording, as in the provenance.
    pub recording: String,
    /// Digest of the recording.
    pub digest: String,
    /// Number of scored samples in the recording.
    pub samples: usize,
    /// Scores of the metrics that use predictions, with intervals by the contact points of the recording.
    #[serde(rename = "metrics", with = "by_metric")]
    pub scores: Vec<Score>,
    /// Skipped metrics with their reasons.
    pub skipped: Vec<Skip>,
}

/// Skipped metric or stage of an evaluation, with the reason.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Skip {
    /// Skipped item: `metric:r_light`.
    pub what: String,
    /// Reason for the skip.
    pub reason: String,
}

impl From<&Skipped> for Skip {
    fn from(skipped: &Skipped) -> Skip {
        Skip {
            what: skipped.what.clone(),
            reason: skipped.reason.to_string(),
        }
    }
}

impl EvaluationReport {
    /// Report of `evaluation` for one recording, without the table of samples.
    pub fn new(
        subject: Subject,
        evaluation: &Evaluation,
        provenance: Provenance,
    ) -> EvaluationReport {
        EvaluationReport {
            schema: EVALUATION_SCHEMA.to_owned(),
            subject,
            scores: scores(evaluation),
            skipped: evaluation.skipped().iter().map(Skip::from).collect(),
            provenance,
            by_recording: Vec::new(),
            by_group: Vec::new(),
            over_seeds: None,
            tasks: Vec::new(),
            samples: None,
        }
    }

    /// Report of an `evaluation` of arrays in memory, for an unknown sensor.
    pub fn of_arrays(evaluation: &Evaluation) -> EvaluationReport {
        let provenance = Provenance {
            taceva: env!("CARGO_PKG_VERSION").to_owned(),
            ..Provenance::default()
        };
        EvaluationReport::new(Subject::default(), evaluation, provenance)
    }

    /// Score of `metric` on the channel or plane `channel`; `None` if the report lacks the score.
    pub fn score(&self, metric: &str, channel: &str) -> Option<&Score> {
        let mut scores = self.scores.iter();
        scores.find(|score| score.metric == metric && score.channel == channel)
    }
}

impl RecordingScores {
    /// Scores of `evaluation` for `samples` samples of the recording called `recording`.
    pub fn new(
        recording: String,
        digest: String,
        samples: usize,
        evaluation: &Evaluation,
    ) -> RecordingScores {
        RecordingScores {
            recording,
            digest,
            samples,
            scores: scores(evaluation),
            skipped: evaluation.skipped().iter().map(Skip::from).collect(),
        }
    }
}
