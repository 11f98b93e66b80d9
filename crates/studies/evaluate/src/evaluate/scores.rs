//! Scores of predictions, and their provenance.

use std::num::NonZeroUsize;

use taceva_core::{Channel, Channels, Field, FieldSet};
use taceva_dataset::Dataset;
use taceva_metrics::{MetricPlan, catalogue};
use taceva_models::Model;
use taceva_results::{ModelProvenance, Provenance, RecordingScores};

use super::notes::{few_clusters, within};
use super::passes::Passes;
use super::request::{Asked, Evaluated};
use crate::assess::{Assessed, Context, FitFacts, ScoredRows, assess};
use crate::calibration::calibration;
use crate::error::EvaluateError;
use crate::note::{Division, Independence, Note};
use crate::predict::{Predicted, Target};
use crate::provenance::{self, choices};
use crate::recordings::{self, Clusters};
use crate::rotation::rotations;
use crate::rows::Divided;
use crate::samples;
use crate::sensor_facts;
use crate::skill::with_skill;
use crate::subject;

/// The requested metrics that can be computed, given the facts of `dataset`.
pub(super) fn metrics(
    dataset: &Dataset,
    channels: &Channels,
    asked: Asked<'_>,
) -> Result<MetricPlan, EvaluateError> {
    let wanted = catalogue::select(asked.metrics.iter().map(String::as_str))?;
    let available: FieldSet = dataset.fields().with(Field::Prediction);
    let facts = sensor_facts::of_dataset(dataset, asked.sensor)?;
    Ok(MetricPlan::new(&with_skill(wanted), channels.clone(), available).with_facts(facts))
}

/// Description of the model, or of several models, behind a result.
pub struct Behind {
    /// Origin of the model.
    pub model: ModelProvenance,
    /// Notes on the model.
    pub notes: Vec<Note>,
    /// Facts of the fit, if the model was fitted for this result.
    pub(super) fit: FitFacts,
}

impl Behind {
    /// Description of `model` from its card, in the form of a report.
    ///
    /// # Errors
    /// [`EvaluateError::ModelFormat`] for a model that cannot be written to a file.
    pub fn of(model: &Model) -> Result<Behind, EvaluateError> {
        Ok(Behind {
            model: provenance::model(model)?,
            notes: choices(model).collect(),
            fit: FitFacts::default(),
        })
    }
}

/// Scores predictions, and adds their provenance.
pub fn score(
    dataset: &Dataset,
    asked: Asked<'_>,
    behind: Behind,
    target: &Target,
    predicted: &Predicted,
    jobs: NonZeroUsize,
) -> Result<Evaluated, EvaluateError> {
    let plan = metrics(dataset, predicted.channels(), asked)?
        .with_constants(predicted.constants().clone())?;
    let clusters = Clusters::of(dataset, &target.rows);
    let divided = target.divided.as_ref();
    let groups = divided.and_then(|divided| divided.groups.as_deref());
    let independence = independence(dataset, asked, target);
    let plan = match (independence, groups) {
        (Some(_), _) => plan.independent_samples(),
        (None, Some(_)) => plan.by_group(),
        (None, None) => plan,
    };
    let by_recording = by_recording(dataset, &plan, asked, target, predicted, jobs)?;
    let plan = match clusters.is_some_and(Clusters::are_recordings) {
        true => plan.by_recording(),
        false => plan,
    };
    let passes = Passes::new(&plan, groups, asked.part.is_some());
    let evaluator = passes.run(dataset, predicted, &target.rows, jobs)?;
    let neighbours = divided.and_then(|divided| divided.neighbours.clone());
    let split = divided.and_then(|divided| divided.split.note.clone());
    let are_counted = independence.is_some() || clusters.is_some_and(Clusters::are_recordings);
    let few = match are_counted {
        true => None,
        false => few_clusters(dataset, target, predicted.points()),
    };
    let are_neighbours_learnt = matches!(
        neighbours,
        Some(Note::Neighbours {
            division: Division::Separated { .. },
            ..
        })
    );
    let first_line = neighbours.as_ref().map(Note::to_string);
    let mut notes: Vec<Note> = neighbours.into_iter().collect();
    notes.extend(split.map(Note::Split));
    notes.extend(independence.map(Note::Independent));
    notes.extend(clusters.map(Clusters::note));
    notes.extend(within(dataset, target));
    notes.extend(few);
    notes.extend(recordings::extended(dataset));
    notes.extend(recordings::reduced(dataset));
    notes.extend(recordings::depth_zeros(dataset));
    notes.extend(recordings::viewed(dataset));
    notes.extend(recordings::imported(dataset));
    notes.extend(recordings::device_warnings(dataset));
    notes.extend(rotations(dataset, predicted));
    notes.extend(target.notes(dataset, &behind.model));
    notes.extend(Note::left_out(target.part.name(), predicted.left_out));
    notes.extend(predicted.beyond());
    notes.extend(calibration(
        dataset,
        predicted,
        &target.rows,
        |_| true,
        jobs,
    )?);
    notes.extend(behind.notes);
    notes.extend(passes.note(dataset));
    let provenance = Provenance {
        model: Some(behind.model),
        split: divided.map(|divided| divided.spec.to_string()),
        neighbours: first_line,
        seed: divided.map(|divided| divided.seed),
        part: Some(target.part.name().to_owned()),
        samples: divided.map(Divided::counts).unwrap_or_default(),
        frames_decoded: predicted.frames_decoded,
        ..provenance::of(dataset)
    };
    let mut samples = samples::of(dataset, &target.rows)?;
    if let Some(divided) = divided {
        samples::add_division(&mut samples, &target.rows, divided);
    }
    samples::add_predictions(&mut samples, &target.rows, predicted, &target.rows);
    // For an angle with a period, the error is not the difference of the columns of the table.
    let channels = predicted.channels().iter();
    let channels = channels.filter(|channel| channel.period().is_none());
    notes.extend(channels.filter_map(|channel| {
        Some(Note::Dominant {
            channel: channel.name().to_owned(),
            sample: samples.dominant(channel.name())?,
        })
    }));
    let rows = ScoredRows::Accumulated {
        evaluator: Box::new(evaluator),
        taken: recordings::taken(dataset, &target.rows),
    };
    let context = Context {
        notes,
        are_neighbours_learnt,
        fit: behind.fit,
        by_recording,
        samples: Some(samples),
        ..Context::new(subject::of(dataset), provenance)
    };
    let Assessed { report, state } = assess(rows, predicted.bounded(0..predicted.rows()), context)?;
    Ok(Evaluated {
        report,
        state: state.expect("accumulators have a state"),
        manifest: None,
        shares: predicted.shares().map(<[f64]>::to_vec),
    })
}

/// Reason why samples of `target` are treated as independent; `None` if they are not.
fn independence(dataset: &Dataset, asked: Asked<'_>, target: &Target) -> Option<Independence> {
    let found = target.divided.as_ref();
    let channels = dataset.table().channels();
    let has_places = [Channel::PX, Channel::PY]
        .iter()
        .all(|place| channels.position(place.name()).is_some());
    match (
        asked.is_independent,
        found.is_some_and(|divided| divided.are_independent),
    ) {
        (true, _) => Some(Independence::Stated),
        (false, true) => Some(Independence::Found { has_places }),
        (false, false) => None,
    }
}

/// Scores of each single recording, if several were joined.
fn by_recording(
    dataset: &Dataset,
    plan: &MetricPlan,
    asked: Asked<'_>,
    target: &Target,
    predicted: &Predicted,
    jobs: NonZeroUsize,
) -> Result<Vec<RecordingScores>, EvaluateError> {
    let divided = target.divided.as_ref();
    let groups = divided.and_then(|divided| divided.groups.as_deref());
    let passes = Passes::new(plan, groups, asked.part.is_some());
    let rows = &target.rows;
    let mut scores = Vec::new();
    for recording in dataset.recordings() {
        let bound = |row: usize| rows.partition_point(|own| *own < row);
        let own = bound(recording.rows().start)..bound(recording.rows().end);
        let evaluation = passes.of_recording(dataset, predicted, rows, own.clone(), jobs)?;
        let evaluation = match target.is_seen() {
            true => evaluation.of_seen_samples(),
            false => evaluation,
        };
        scores.push(RecordingScores::new(
            recording.name().to_owned(),
            recording.dataset().digest().to_string(),
            own.len(),
            &evaluation,
        ));
    }
    Ok(scores)
}
