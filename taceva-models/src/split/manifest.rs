//! Record of a split: seed and sample ids, from which its parts can be reproduced.

use serde::{Deserialize, Serialize};

use super::assign::Split;
use super::error::SplitError;
use super::part::Part;
use super::spec::SplitSpec;

/// Record of a split. Lists the sample ids of each part.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SplitManifest {
    /// Specification of the split in its standard spelling, with its fractions.
    pub split: String,
    /// Seed of the random assignment of samples to parts.
    pub seed: u64,
    /// Number of samples in each part.
    pub counts: SplitCounts,
    /// Note about the split, such as the reason for omitted samples; `None` for no note.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// Ids of the training samples.
    pub train: Vec<String>,
    /// Ids of the validation samples, on which model settings are chosen.
    pub validation: Vec<String>,
    /// Ids of the test samples.
    pub test: Vec<String>,
    /// Ids of the test samples of each fold; empty if the split is not a cross-validation.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub folds: Vec<Vec<String>>,
}

/// Number of samples in each part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SplitCounts {
    /// Number of training samples.
    pub train: usize,
    /// Number of validation samples, on which model settings are chosen.
    pub validation: usize,
    /// Number of test samples.
    pub test: usize,
    /// Number of omitted samples, which belong to no part.
    pub left_out: usize,
}

impl SplitCounts {
    /// Counts the samples of each part of `split`.
    pub fn of(split: &Split) -> SplitCounts {
        SplitCounts {
            train: split.train.len(),
            validation: split.validation.len(),
            test: split.test.len(),
            left_out: split.left_out.len(),
        }
    }
}

impl SplitManifest {
    /// Creates the record of `split`. `ids` contains the id of each row.
    ///
    /// # Errors
    /// [`SplitError::Length`] if the number of `ids` differs from the number of rows of the split.
    pub fn new(
        spec: &SplitSpec,
        seed: u64,
        split: &Split,
        ids: &[String],
    ) -> Result<SplitManifest, SplitError> {
        let counts = SplitCounts::of(split);
        let rows = counts.train + counts.validation + counts.test + counts.left_out;
        if ids.len() != rows {
            return Err(SplitError::Length {
                what: "ids".into(),
                found: ids.len(),
                rows,
            });
        }
        let of = |part| {
            split
                .rows(part)
                .iter()
                .map(|&row| ids[row].clone())
                .collect()
        };
        Ok(SplitManifest {
            split: spec.to_string(),
            seed,
            counts,
            note: split.note.clone(),
            train: of(Part::Train),
            validation: of(Part::Validation),
            test: of(Part::Test),
            folds: Vec::new(),
        })
    }

    /// Returns the record with the ids of the test samples of each fold.
    #[must_use]
    pub fn with_folds(self, folds: Vec<Vec<String>>) -> SplitManifest {
        SplitManifest { folds, ..self }
    }
}
