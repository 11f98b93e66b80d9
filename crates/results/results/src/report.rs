//! Evaluation reports.

use serde::{Deserialize, Serialize};
use taceva_core::Skipped;
use taceva_metrics::Evaluation;

use crate::provenance::Provenance;
use crate::samples::Samples;
use crate::score::{Score, by_metric, scores};
use crate::seeds::OverSeeds;
use crate::subject::Subject;

/// Schema of one evaluation.
///
/// Unreleased versions wrote `taceva.evaluation/1` and 1.1 to 1.4; the schema after this one is 1.5.
pub const EVALUATION_SCHEMA: &str = "taceva.evaluation/1.0";

/// Scores of one sensor with their subject and provenance.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct EvaluationReport {
    /// [`EVALUATION_SCHEMA`].
    pub schema: String,
    /// The sensor.
    pub subject: Subject,
    /// Every score, in the order of the catalogue.
    #[serde(rename = "metrics", with = "by_metric")]
    pub scores: Vec<Score>,
    /// Metrics that were skipped.
    #[serde(default)]
    pub skipped: Vec<Skip>,
    /// The inputs and settings behind the scores.
    #[serde(default)]
    pub provenance: Provenance,
    /// The scores of each recording alone, where several were taken as one.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub by_recording: Vec<RecordingScores>,
    /// The same scores with other seeds of the training, where they were asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub over_seeds: Option<OverSeeds>,
    /// The samples behind the scores, where they are at hand; no part of the JSON.
    #[serde(skip)]
    pub samples: Option<Samples>,
}

/// Scores of the samples of one of several recordings.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct RecordingScores {
    /// Its name, as in the provenance.
    pub recording: String,
    /// Its digest.
    pub digest: String,
    /// The number of its samples that are scored.
    pub samples: usize,
    /// The scores of predictions, with intervals by its contact points.
    #[serde(rename = "metrics", with = "by_metric")]
    pub scores: Vec<Score>,
    /// Metrics that were skipped.
    pub skipped: Vec<Skip>,
}

/// Metric or stage that was skipped, with the reason.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Skip {
    /// The thing: `metric:r_light`.
    pub what: String,
    /// The reason.
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
    /// A report of `evaluation`, of one recording and without samples.
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
            over_seeds: None,
            samples: None,
        }
    }

    /// A report of numbers that a program held in memory, of an unknown sensor.
    pub fn of_arrays(evaluation: &Evaluation) -> EvaluationReport {
        let provenance = Provenance {
            taceva: env!("CARGO_PKG_VERSION").to_owned(),
            ..Provenance::default()
        };
        EvaluationReport::new(Subject::default(), evaluation, provenance)
    }

    /// The score of one metric and channel or plane.
    pub fn score(&self, metric: &str, channel: &str) -> Option<&Score> {
        let mut scores = self.scores.iter();
        scores.find(|score| score.metric == metric && score.channel == channel)
    }
}

impl RecordingScores {
    /// The scores of `evaluation`, of `samples` samples of the recording called `recording`.
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
