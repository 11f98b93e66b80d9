//! Merges the state files of several shards, and computes their scores.

use std::borrow::Borrow;
use std::path::{Path, PathBuf};

use taceva_core::shown;
use taceva_metrics::{Evaluation, Evaluator};

use crate::assess::{Assessed, Context, FitFacts, ScoredRows, assess};
use crate::error::EvaluateError;
use crate::note::Note;
use crate::row_ledger::{AllTaken, Taken};
use crate::state_file::{ReadState, StateFile};
use taceva_results::EvaluationReport;

/// Report with the scores of several states whose plans differ, such as the states of the phases of a run. No sums are merged.
///
/// # Errors
/// [`EvaluateError::State`] for a file that is not a state of its plan. [`EvaluateError::Request`] without a file.
pub fn side_by_side(states: &[ReadState]) -> Result<EvaluationReport, EvaluateError> {
    let parts: Vec<Evaluation> = states.iter().map(evaluation_of).collect::<Result<_, _>>()?;
    report_of(states, parts)
}

/// Scores of one state.
///
/// # Errors
/// [`EvaluateError::State`] for a file that is not a state of its plan.
pub(crate) fn evaluation_of(state: &ReadState) -> Result<Evaluation, EvaluateError> {
    let ReadState { path, file, .. } = state;
    let mut evaluator = Evaluator::new(&file.plan.to_plan(path)?);
    let merged = evaluator.merge_states(&file.states);
    merged.map_err(|error| EvaluateError::State {
        path: path.clone(),
        problem: error.to_string(),
    })?;
    file.finish(evaluator)
}

/// Report with the scores `parts`, one for each of `states`. Subject and provenance are from the first state, and phases from all states.
///
/// # Errors
/// [`EvaluateError::Request`] without a state. [`EvaluateError::State`] for two states that name a phase for one metric.
pub(crate) fn report_of(
    states: &[ReadState],
    parts: Vec<Evaluation>,
) -> Result<EvaluationReport, EvaluateError> {
    let first = &states.first().ok_or_else(no_state)?.file;
    let mut provenance = first.provenance.clone();
    for ReadState { path, file, .. } in states.iter().skip(1) {
        for (metric, phase) in &file.provenance.phases {
            let known = provenance.phases.insert(metric.clone(), phase.clone());
            if known.is_some() {
                return Err(EvaluateError::State {
                    path: path.clone(),
                    problem: format!("the metric `{}` is also in another state", shown(metric)),
                });
            }
        }
    }
    let evaluation = Evaluation::joined(parts, Vec::new());
    let subject = first.subject.clone();
    Ok(EvaluationReport::new(subject, &evaluation, provenance))
}

fn no_state() -> EvaluateError {
    EvaluateError::Request("no state file is given, expected one or more".to_owned())
}

/// Merges several states, and returns their common scores and the merged state.
///
/// # Errors
/// [`EvaluateError::State`] with the first file that does not match the first state. [`EvaluateError::Request`] without a file.
pub fn merge(paths: &[PathBuf]) -> Result<(EvaluationReport, StateFile), EvaluateError> {
    merged(paths.iter().map(|path| ReadState::read(path)))
}

/// Merges several states that were already read, as [`merge`] does with files.
///
/// # Errors
/// Errors of [`merge`].
pub fn merge_read(states: &[ReadState]) -> Result<(EvaluationReport, StateFile), EvaluateError> {
    merged(states.iter().map(Ok))
}

/// Merges states one by one. If `states` reads each state only when needed, at most two are in memory.
fn merged<S: Borrow<ReadState>>(
    mut states: impl Iterator<Item = Result<S, EvaluateError>>,
) -> Result<(EvaluationReport, StateFile), EvaluateError> {
    let first = states.next().ok_or_else(no_state)??;
    let ReadState {
        path: first_path,
        file: first,
        digest,
    } = Borrow::<ReadState>::borrow(&first);
    let mut count = 1;
    let mut all_taken = AllTaken::default();
    let mut take_rows = |path: &Path, digest: &str, taken: &[Taken]| {
        all_taken
            .add(path, digest, taken)
            .map_err(|problem| EvaluateError::State {
                path: path.to_owned(),
                problem,
            })
    };
    take_rows(first_path, digest, &first.taken)?;
    let plan = first.plan.to_plan(first_path)?;
    let mut constants = first.plan.constants.clone();
    let mut evaluator = Evaluator::new(&plan);
    let mut provenance = first.provenance.clone();
    let mut bounded = first.bounded.clone();
    let mut is_seen = first.seen;
    let mut are_neighbours_learnt = first.neighbours;
    let mut subject = first.subject.clone();
    let mut take = |path: &Path, file: &StateFile| -> Result<(), EvaluateError> {
        let wrong = |problem: String| EvaluateError::State {
            path: path.to_owned(),
            problem,
        };
        if !file.plan.merges_with(&first.plan) {
            let problem =
                "another plan: metrics, channels, sensor facts and settings must be equal";
            return Err(wrong(format!(
                "{problem} to those of {}",
                shown(first_path)
            )));
        }
        let states = evaluator.merge_states(&file.states);
        states.map_err(|error| wrong(error.to_string()))
    };
    take(first_path, first)?;
    for state in states {
        let state = state?;
        let ReadState { path, file, digest } = Borrow::<ReadState>::borrow(&state);
        count += 1;
        take_rows(path, digest, &file.taken)?;
        take(path, file)?;
        // Models fitted on different samples have different constants. Their skill is measured against the mean of the truth.
        constants.retain(|channel, constant| {
            let other = file.plan.constants.get(channel);
            other.is_some_and(|other| other.to_bits() == constant.to_bits())
        });
        is_seen |= file.seen;
        are_neighbours_learnt |= file.neighbours;
        subject = subject.joined(&file.subject);
        provenance = provenance.joined(&file.provenance);
        bounded = bounded.joined(&file.bounded);
    }
    let mut finished = Evaluator::new(&plan.with_constants(constants)?);
    finished.merge(evaluator)?;
    let is_of_shards = all_taken.is_of_shards_of_one_input();
    let taken = all_taken.into_taken();
    // Neither a single state nor a complete set of shards of one input needs a note.
    let (mut notes, mut of_report) = (Vec::new(), Vec::new());
    match (
        is_of_shards || count == 1,
        taken.first().and_then(Taken::share),
    ) {
        (false, _) => notes.push(Note::States(count)),
        (true, Some(share)) => of_report.push(Note::Shards(share)),
        (true, None) => {}
    }
    let rows = ScoredRows::Accumulated {
        evaluator: Box::new(finished),
        taken,
    };
    let context = Context {
        notes,
        is_seen,
        are_neighbours_learnt,
        fit: FitFacts {
            frames_decoded: 0,
            notes: of_report,
        },
        ..Context::new(subject, provenance)
    };
    let Assessed { report, state } = assess(rows, bounded, context)?;
    Ok((report, state.expect("accumulators have a state")))
}
