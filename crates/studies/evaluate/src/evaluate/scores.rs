//! From predictions to scores, with where they come from.

use std::num::NonZeroUsize;

use taceva_core::{Channels, Field, FieldSet};
use taceva_dataset::Dataset;
use taceva_metrics::{MetricPlan, catalogue};
use taceva_models::Model;

use super::notes::{
    copies_note, elsewhere_note, few_points_note, left_out_note, seen_note, stage_note,
};
use super::passes::Passes;
use super::request::{Asked, Evaluated};
use crate::calibration::calibration_note;
use crate::error::EvaluateError;
use crate::facts;
use crate::predict::{Predicted, Target};
use crate::provenance::{ModelProvenance, Provenance, chosen_notes};
use crate::recordings::{self, Clusters};
use crate::report::{EvaluationReport, RecordingScores};
use crate::rows::Divided;
use crate::samples::Samples;
use crate::skill::with_skill;
use crate::state_file::StateFile;
use crate::subject::Subject;

/// The metrics that are asked for, of what is known of `dataset`.
pub(super) fn metrics(
    dataset: &Dataset,
    channels: &Channels,
    asked: Asked<'_>,
) -> Result<MetricPlan, EvaluateError> {
    let wanted = catalogue::select(asked.metrics.iter().map(String::as_str))?;
    let available: FieldSet = dataset.fields().with(Field::Prediction);
    let facts = facts::of_dataset(dataset, asked.sensor)?;
    Ok(MetricPlan::new(&with_skill(wanted), channels.clone(), available).with_facts(facts))
}

/// What a result says of the model, or the models, behind it.
pub struct Behind {
    pub(super) model: ModelProvenance,
    /// Files of models without a seal.
    pub(super) unsealed: Vec<String>,
    /// What was chosen where a person left it open.
    pub(super) chosen: Vec<String>,
}

impl Behind {
    pub fn of(model: &Model) -> Result<Behind, EvaluateError> {
        Ok(Behind {
            model: ModelProvenance::of(model)?,
            unsealed: Provenance::unsealed_model(model).into_iter().collect(),
            chosen: chosen_notes(model).collect(),
        })
    }
}

/// The scores of what was predicted, with where they come from.
pub fn score(
    dataset: &Dataset,
    asked: Asked<'_>,
    behind: Behind,
    (target, predicted): (&Target, &Predicted),
    jobs: NonZeroUsize,
) -> Result<Evaluated, EvaluateError> {
    let plan = metrics(dataset, predicted.channels(), asked)?
        .with_constants(predicted.constants().clone())?;
    let clusters = Clusters::of(dataset, &target.rows);
    let by_recording = by_recording(dataset, (&plan, asked), (target, predicted), jobs)?;
    let plan = match clusters.is_some_and(Clusters::are_recordings) {
        true => plan.by_recording(),
        false => plan,
    };
    let points: Option<Vec<&str>> = predicted
        .points()
        .map(|points| points.iter().map(String::as_str).collect());
    let passes = Passes::new(&plan, asked.part.is_some());
    let mut evaluator = passes.run(dataset, predicted, &target.rows, jobs)?;
    let divided = target.divided.as_ref();
    let note = divided.and_then(|divided| divided.split.note.clone());
    let few_points = match clusters.is_some_and(Clusters::are_recordings) {
        true => None,
        false => few_points_note(points.as_deref()),
    };
    let elsewhere = elsewhere_note(target, &behind.model);
    let fitted_on = behind.model.fitted_on.clone();
    let mut provenance = Provenance {
        model: Some(behind.model),
        split: divided.map(|divided| divided.spec.to_string()),
        seed: divided.map(|divided| divided.seed),
        part: Some(target.part.name().to_owned()),
        samples: divided.map(Divided::counts).unwrap_or_default(),
        frames_decoded: predicted.frames_decoded,
        notes: note
            .into_iter()
            .chain(clusters.map(Clusters::note))
            .chain(few_points)
            .chain(recordings::extended_notes(dataset))
            .chain(recordings::reduced_notes(dataset))
            .chain(seen_note(target))
            .chain(elsewhere)
            .chain(copies_note(dataset, target))
            .chain(stage_note(dataset, &fitted_on))
            .chain(left_out_note(target.part.name(), predicted.left_out))
            .chain(predicted.bounded_note())
            .chain(calibration_note(
                dataset,
                (predicted, &target.rows),
                |_| true,
                jobs,
            )?)
            .chain(behind.chosen)
            .chain(passes.note(dataset))
            .collect(),
        ..Provenance::of(dataset)
    };
    provenance.unsealed.extend(behind.unsealed);
    let subject = Subject::of(dataset);
    let bounded = predicted.bounded(0..predicted.rows());
    let state = StateFile::of(&mut evaluator, &subject, &provenance, bounded)?
        .with_taken(recordings::taken(dataset, &target.rows));
    let evaluation = state.finish(evaluator)?;
    let samples = Samples::of(dataset, &target.rows)?
        .with_predictions(&target.rows, (predicted, &target.rows));
    Ok(Evaluated {
        report: EvaluationReport::new(subject, evaluation, provenance)
            .with_samples(samples)
            .with_recordings(by_recording),
        state,
        manifest: None,
    })
}

/// The scores of each recording alone, where several were joined.
fn by_recording(
    dataset: &Dataset,
    (plan, asked): (&MetricPlan, Asked<'_>),
    (target, predicted): (&Target, &Predicted),
    jobs: NonZeroUsize,
) -> Result<Vec<RecordingScores>, EvaluateError> {
    let passes = Passes::new(plan, asked.part.is_some());
    let rows = &target.rows;
    let mut scores = Vec::new();
    for recording in dataset.recordings() {
        let bound = |row: usize| rows.partition_point(|own| *own < row);
        let own = bound(recording.rows().start)..bound(recording.rows().end);
        let evaluation = passes.of_recording(dataset, predicted, (rows, own.clone()), jobs)?;
        scores.push(RecordingScores {
            recording: recording.name().to_owned(),
            digest: recording.dataset().digest().to_string(),
            samples: own.len(),
            evaluation: match seen_note(target) {
                Some(_) => evaluation.of_seen_samples(),
                None => evaluation,
            },
        });
    }
    Ok(scores)
}
