//! Scores two tables by the plan in a state file that was computed from them.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::path::Path;

use taceva_dataset::SensorFile;

use super::agreement::Matching;
use super::row_key::{RowKey, RowKeys};
use super::row_pairs::PairedRows;
use super::{ScorePlan, ScoreRequest, fields, tables};
use crate::accumulate;
use crate::error::EvaluateError;
use crate::recount::Recount;
use crate::state_file::ReadState;

/// Scores the tables `truth` and `prediction` by the plan of `state`. `key` is the key that the caller chose in the original scoring, if any.
///
/// # Errors
/// [`EvaluateError::State`] for a state that was summed from other tables. Otherwise errors of [`Scoring::read`](super::Scoring::read).
pub fn recount_tables(
    state: &ReadState,
    truth: &Path,
    prediction: &Path,
    key: Option<&RowKey>,
    jobs: NonZeroUsize,
) -> Result<Recount, EvaluateError> {
    let ReadState { path, file, .. } = state;
    let metrics = file.plan.to_plan(path)?;
    // The plan states metrics, units, periods and facts. Invalid cells were counted or rejected when the tables were first scored.
    let request = ScoreRequest {
        truth: truth.to_owned(),
        prediction: prediction.to_owned(),
        units: Vec::new(),
        periods: Vec::new(),
        key: key.cloned(),
        is_independent: false,
        sensor: None,
        metrics: Vec::new(),
        allow_invalid: true,
        jobs,
    };
    let [(truth, of_truth), (prediction, of_prediction)] = tables::read_both(&request)?;
    tables::check_rows(&truth)?;
    tables::check_rows(&prediction)?;
    let found: BTreeMap<String, String> = [("truth", of_truth), ("prediction", of_prediction)]
        .map(|(role, digest)| (role.to_owned(), digest.to_string()))
        .into();
    if found != file.provenance.tables {
        let [expected, found] = [&file.provenance.tables, &found].map(tables::input_of);
        return Err(EvaluateError::State {
            path: path.clone(),
            problem: format!(
                "the state was summed from other tables, {expected}, found {found}: name those tables"
            ),
        });
    }
    let channels = metrics.channels().clone();
    let is_declared = |name: &str| channels.position(name).is_some();
    let plan = ScorePlan {
        keys: RowKeys::of(&truth, &prediction, request.key.as_ref(), is_declared)?,
        places: fields::places(&truth, &prediction)?,
        sensor: SensorFile::default(),
        metrics,
    };
    let (pairing, key) = tables::pair(&truth, &prediction, &plan.keys)?;
    let matching = Matching::of([&truth, &prediction], &plan.keys, key)?;
    let rows = PairedRows::new([&truth, &prediction], &pairing, &matching, &plan, true)?;
    let evaluator = accumulate::accumulate(&rows, &plan.metrics, jobs)?;
    Recount::of(file, evaluator, Vec::new())
}
