//! Builds a report from scores, with its subject and its provenance.

use taceva_metrics::{Evaluation, Evaluator};
use taceva_results::{
    EvaluationReport, OverSeeds, Provenance, RecordingScores, Samples, Subject, group_errors,
    kept_together,
};

use crate::bounded_share::Bounded;
use crate::error::EvaluateError;
use crate::note::{Detection, Note};
use crate::row_ledger::Taken;
use crate::state_file::StateFile;

/// Rows that were scored.
pub enum ScoredRows {
    /// Accumulators, whose sums can be merged with those of other rows.
    Accumulated {
        /// Evaluator with the accumulators.
        evaluator: Box<Evaluator>,
        /// Rows that the evaluator has accumulated.
        taken: Vec<Taken>,
    },
    /// A finished evaluation of several groups of rows, whose sums cannot be merged.
    Finished(Box<Evaluation>),
}

/// Parts of a report besides its scores.
pub struct Context {
    /// Description of the sensor.
    pub subject: Subject,
    /// Inputs and settings.
    pub provenance: Provenance,
    /// Notes for the reader, in order. Notes of states that were read are already in `provenance`.
    pub notes: Vec<Note>,
    /// True if the model was fitted on some of the rows, even if `provenance` does not show this.
    pub is_seen: bool,
    /// True if the training part contains neighbours that resemble tested samples.
    pub are_neighbours_learnt: bool,
    /// Facts of the fit behind the predictions. Stored states of scores do not contain them.
    pub fit: FitFacts,
    /// Scores of each recording, if several were joined.
    pub by_recording: Vec<RecordingScores>,
    /// Scores for other training seeds, if any.
    pub over_seeds: Option<OverSeeds>,
    /// All samples, if a single call evaluates all of them.
    pub samples: Option<Samples>,
}

/// Facts of a fit that are known only to the call that made the fit.
#[derive(Clone, Debug, Default)]
pub struct FitFacts {
    /// Number of frames that the fit decoded.
    pub frames_decoded: u64,
    /// Notes for the reader, placed after all others.
    pub notes: Vec<Note>,
}

/// A report, and the state file with its sums, if the sums can be stored.
pub struct Assessed {
    /// Report of the evaluation.
    pub report: EvaluationReport,
    /// Sums behind the report; `None` for a finished evaluation.
    pub state: Option<StateFile>,
}

impl Context {
    /// A context without notes, recordings, seeds or samples.
    pub fn new(subject: Subject, provenance: Provenance) -> Context {
        Context {
            subject,
            provenance,
            notes: Vec::new(),
            is_seen: false,
            are_neighbours_learnt: false,
            fit: FitFacts::default(),
            by_recording: Vec::new(),
            over_seeds: None,
            samples: None,
        }
    }
}

/// Report of `rows`. `predictions` counts the predictions beyond the bounds of their model.
///
/// # Errors
/// [`EvaluateError::Scores`] for samples that the accumulators reject.
pub fn assess(
    rows: ScoredRows,
    predictions: Bounded,
    context: Context,
) -> Result<Assessed, EvaluateError> {
    let mut provenance = context.provenance;
    let sentences = |notes: &[Note]| notes.iter().map(Note::to_string).collect::<Vec<_>>();
    provenance.notes.extend(sentences(&context.notes));
    let (evaluation, state) = match rows {
        ScoredRows::Finished(evaluation) => (*evaluation, None),
        ScoredRows::Accumulated {
            mut evaluator,
            taken,
        } => {
            let state = StateFile::of(&mut evaluator, &context.subject, &provenance, predictions)?
                .with_taken(taken)
                .with_seen(context.is_seen)
                .with_neighbours(context.are_neighbours_learnt);
            (state.finish(*evaluator)?, Some(state))
        }
    };
    provenance.frames_decoded += context.fit.frames_decoded;
    provenance.notes.extend(sentences(&context.fit.notes));
    let mut report = EvaluationReport::new(context.subject, &evaluation, provenance);
    report.by_recording = context.by_recording;
    report.over_seeds = context.over_seeds;
    report.samples = context.samples;
    let is_by_column = report.provenance.split.as_deref();
    let is_by_column =
        is_by_column.is_some_and(|split| kept_together(split).starts_with("by-column:"));
    if let Some(samples) = report.samples.as_ref().filter(|_| is_by_column) {
        report.by_group = group_errors(samples, &report.scores);
    }
    if let Some(detection) = Detection::of(&report.scores) {
        let notes = &mut report.provenance.notes;
        notes.push(Note::DetectionLimit(detection).to_string());
    }
    let units = Note::likely_units(&report.scores);
    report.provenance.notes.extend(sentences(&units));
    Ok(Assessed { report, state })
}
