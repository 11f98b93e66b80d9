//! A split as a record, so that others can use the same parts.

use serde::{Deserialize, Serialize};

use super::assign::Split;
use super::error::SplitError;
use super::part::Part;
use super::spec::SplitSpec;

/// Which samples went where, by their ids.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SplitManifest {
    /// The split as people write it, with its fractions.
    pub split: String,
    /// The seed.
    pub seed: u64,
    /// Samples in each part.
    pub counts: SplitCounts,
    /// What a reader should know.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub note: Option<String>,
    /// The ids of the samples learnt from.
    pub train: Vec<String>,
    /// The ids of the samples by which settings are chosen.
    pub validation: Vec<String>,
    /// The ids of the samples measured on.
    pub test: Vec<String>,
}

/// Samples in each part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SplitCounts {
    /// Learnt from.
    pub train: usize,
    /// Settings are chosen by them.
    pub validation: usize,
    /// Measured on.
    pub test: usize,
    /// In none of the parts.
    pub left_out: usize,
}

impl SplitCounts {
    /// The counts of `split`.
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
    /// The record of `split`, whose rows have `ids`.
    ///
    /// # Errors
    /// [`SplitError::Length`] if `ids` are fewer or more than the rows of the split.
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
        })
    }
}
