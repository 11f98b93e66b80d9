//! A finished evaluation: the scores, what they are about, and where they come from.

use serde::ser::SerializeSeq;
use serde::{Serialize, Serializer};
use taceva_core::Skipped;
use taceva_dataset::SensorFile;
use taceva_metrics::Evaluation;

use crate::over_seeds::OverSeeds;
use crate::provenance::Provenance;
use crate::samples::Samples;
use crate::subject::Subject;

/// The schema of [`EvaluationReport`] as JSON.
pub const EVALUATION_SCHEMA: &str = "taceva.evaluation/1.3";

/// The same of several recordings, with the scores of each.
const SCHEMA_OF_SEVERAL: &str = "taceva.evaluation/1.4";

/// A finished evaluation. Its JSON follows [`EVALUATION_SCHEMA`].
#[derive(Clone, Debug, Serialize)]
pub struct EvaluationReport {
    /// [`EVALUATION_SCHEMA`]; of several recordings `taceva.evaluation/1.4`.
    pub schema: &'static str,
    /// What was evaluated.
    pub subject: Subject,
    /// The scores, and what was skipped.
    #[serde(flatten)]
    pub evaluation: Evaluation,
    /// From what, and how.
    pub provenance: Provenance,
    /// The scores of each recording alone, where several were taken as one.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub by_recording: Vec<RecordingScores>,
    /// The same scores with other seeds of the training, where that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub over_seeds: Option<OverSeeds>,
    /// The samples it was made of, where one call has them all; no part of the JSON.
    #[serde(skip)]
    pub samples: Option<Samples>,
}

/// The scores of the samples of one of several recordings.
#[derive(Clone, Debug, Serialize)]
pub struct RecordingScores {
    /// Its name, as provenance has it.
    pub recording: String,
    /// Its digest.
    pub digest: String,
    /// Samples of it that are scored.
    pub samples: usize,
    /// The scores of predictions, with intervals by its contact points.
    #[serde(flatten)]
    pub evaluation: Evaluation,
}

impl EvaluationReport {
    /// A report of one recording, without samples.
    pub fn new(
        subject: Subject,
        evaluation: Evaluation,
        provenance: Provenance,
    ) -> EvaluationReport {
        EvaluationReport {
            schema: EVALUATION_SCHEMA,
            subject,
            evaluation,
            provenance,
            by_recording: Vec::new(),
            over_seeds: None,
            samples: None,
        }
    }

    /// Scores of numbers that a program held in memory: of what sensor they are is not known, nor whether it was a real one.
    pub fn of_arrays(evaluation: Evaluation) -> EvaluationReport {
        let provenance = Provenance {
            taceva: env!("CARGO_PKG_VERSION").to_owned(),
            ..Provenance::default()
        };
        EvaluationReport::new(
            Subject::of_file(&SensorFile::default()),
            evaluation,
            provenance,
        )
    }

    /// The same with the scores of each recording, where several were taken as one: of these a reader of before 1.4 knows nothing.
    pub fn with_recordings(self, by_recording: Vec<RecordingScores>) -> EvaluationReport {
        EvaluationReport {
            schema: match by_recording.is_empty() {
                true => self.schema,
                false => SCHEMA_OF_SEVERAL,
            },
            by_recording,
            ..self
        }
    }

    /// The same with the samples it was made of.
    pub fn with_samples(self, samples: Samples) -> EvaluationReport {
        EvaluationReport {
            samples: Some(samples),
            ..self
        }
    }
}

/// Skipped things as `[{"what": …, "reason": …}]`.
pub fn skipped<S: Serializer>(list: &[Skipped], serializer: S) -> Result<S::Ok, S::Error> {
    #[derive(Serialize)]
    struct Line<'a> {
        what: &'a str,
        reason: String,
    }
    let mut sequence = serializer.serialize_seq(Some(list.len()))?;
    for skipped in list {
        sequence.serialize_element(&Line {
            what: &skipped.what,
            reason: skipped.reason.to_string(),
        })?;
    }
    sequence.end()
}
