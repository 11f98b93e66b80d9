//! Divisions of a cross-validation, for a caller that fits its own models.

use taceva_core::shown;
use taceva_dataset::{Dataset, Task};
use taceva_models::{FoldSpec, Fractions, SplitKind, SplitSpec};

use super::{folds, task_division};
use crate::error::EvaluateError;
use crate::rows::Divided;

/// Divisions of the cross-validation `split`, such as `cv:5` or `leave-one-recording-out`, one for each fold. Every sample of a group is in the test
/// part of one division.
///
/// # Errors
/// [`EvaluateError::Request`] for a split with a single division. [`EvaluateError::Split`] if the split is invalid, or has more folds than groups.
pub fn fold_divisions(
    dataset: &Dataset,
    split: &str,
    seed: u64,
) -> Result<Vec<Divided>, EvaluateError> {
    let folds = folds::of_spec(dataset, seed, split.parse::<SplitSpec>()?)?;
    let folds = folds.ok_or_else(|| {
        EvaluateError::Request(format!(
            "split `{}` makes one division, expected folds: cv:5, loo or leave-one-recording-out",
            shown(split)
        ))
    })?;
    Ok(folds.into_divisions())
}

/// Folds of some rows of a dataset.
#[derive(Debug)]
#[non_exhaustive]
pub struct FoldedRows {
    /// Division that combines the test parts of all folds.
    pub whole: Divided,
    /// Division of each fold.
    pub folds: Vec<Divided>,
}

impl FoldedRows {
    /// Divides the ascending `rows` of `dataset` by `spec`. All other rows are in no part.
    ///
    /// # Errors
    /// [`EvaluateError::Split`] if the rows lack the groups of `spec`, or have fewer groups than folds.
    pub fn new(
        dataset: &Dataset,
        rows: &[usize],
        spec: FoldSpec,
        seed: u64,
    ) -> Result<FoldedRows, EvaluateError> {
        let whole = SplitSpec {
            kind: SplitKind::Folds(spec.clone()),
            fractions: Fractions::default(),
        };
        let folds = folds::Folds::of_groups(dataset, rows, whole, spec, seed)?;
        let (whole, folds) = folds.into_parts();
        Ok(FoldedRows { whole, folds })
    }
}

/// Default division of `dataset`, if it is a cross-validation. Without a named split, [`evaluate`](crate::evaluate) scores its test part. `None` if
/// the default is a single division.
///
/// # Errors
/// [`EvaluateError::Split`] if the default split cannot be made.
pub fn scored_by_default(dataset: &Dataset, seed: u64) -> Result<Option<Divided>, EvaluateError> {
    Ok(folds::by_default(dataset, seed)?.map(folds::Folds::into_whole))
}

/// Samples that [`evaluate_task`](crate::evaluate_task) scores if no split is named: the test part of the folds of [`task_division`].
///
/// # Errors
/// [`EvaluateError::Request`] for fewer than two clusters, and [`EvaluateError::Split`] if the folds cannot be made.
pub fn scored_of_task(
    dataset: &Dataset,
    task: &Task,
    seed: u64,
) -> Result<Option<Divided>, EvaluateError> {
    let spec = task_division(dataset, task)?.parse::<SplitSpec>()?;
    let of_task = dataset.of_task(&task.name)?;
    Ok(folds::of_spec(&of_task, seed, spec)?.map(folds::Folds::into_whole))
}
