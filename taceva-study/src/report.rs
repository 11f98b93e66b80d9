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

/// A finished evaluation. Its JSON follows [`EVALUATION_SCHEMA`].
#[derive(Clone, Debug, Serialize)]
pub struct EvaluationReport {
    /// [`EVALUATION_SCHEMA`].
    pub schema: &'static str,
    /// What was evaluated.
    pub subject: Subject,
    /// The scores, and what was skipped.
    #[serde(flatten)]
    pub evaluation: Evaluation,
    /// From what, and how.
    pub provenance: Provenance,
    /// The same scores with other seeds of the training, where that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub over_seeds: Option<OverSeeds>,
    /// The samples it was made of, where one call has them all; no part of the JSON.
    #[serde(skip)]
    pub samples: Option<Samples>,
}

impl EvaluationReport {
    pub(crate) fn new(
        subject: Subject,
        evaluation: Evaluation,
        provenance: Provenance,
    ) -> EvaluationReport {
        EvaluationReport {
            schema: EVALUATION_SCHEMA,
            subject,
            evaluation,
            provenance,
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

    /// The same with the samples it was made of.
    pub(crate) fn with_samples(self, samples: Samples) -> EvaluationReport {
        EvaluationReport {
            samples: Some(samples),
            ..self
        }
    }
}

/// Skipped things as `[{"what": …, "reason": …}]`.
pub(crate) fn skipped<S: Serializer>(list: &[Skipped], serializer: S) -> Result<S::Ok, S::Error> {
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
