//! Default cross-validation of a recording, for requests without a split.

use std::collections::BTreeSet;

use taceva_dataset::Dataset;
use taceva_models::{FoldSpec, Fractions, SplitKind, SplitSpec};

use crate::calibration_rows::PlannedRows;
use crate::error::EvaluateError;
use crate::grouping::{Grouping, SplitFields};

/// Default number of folds.
const COUNT: usize = 5;
/// Minimum number of groups for which a single division scores enough groups. For fewer groups, cross-validation is the default.
const GROUPS_MANY: usize = 1000;

/// Default cross-validation of a recording with few groups. `None` for joined recordings, and for a recording of a run, whose plan divides it.
pub(super) fn default_split(dataset: &Dataset) -> Result<Option<SplitSpec>, EvaluateError> {
    if !dataset.recordings().is_empty() || PlannedRows::of(dataset)?.is_some() {
        return Ok(None);
    }
    let rows = dataset.all_rows();
    let spec = FoldSpec {
        count: Some(COUNT),
        by: Grouping::of(dataset, &rows).folds(),
    };
    let kind = SplitKind::Folds(spec.clone());
    let fields = SplitFields::of(dataset, &rows, &kind);
    let groups = spec.groups(&fields.input(rows.len()))?;
    let groups: BTreeSet<&String> = groups.iter().filter(|name| !name.is_empty()).collect();
    // At least one group in each fold, so that intervals have their least number of groups.
    let is_default = (COUNT..GROUPS_MANY).contains(&groups.len());
    Ok(is_default.then(|| SplitSpec {
        kind,
        fractions: Fractions::default(),
    }))
}
