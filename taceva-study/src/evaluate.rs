//! From a dataset to scores, step by step: divide, fit, predict, score.

pub(crate) mod folds;
mod given;
mod passes;

use std::collections::BTreeSet;
use std::num::NonZeroUsize;
use taceva_core::shown;

use taceva_core::{Channels, Field, FieldSet, SkipReason, Skipped};
use taceva_dataset::{Dataset, SensorFile};
use taceva_metrics::{MetricPlan, catalogue};
use taceva_models::{Model, SplitManifest};

use crate::calibration::calibration_note;
use crate::error::StudyError;
use crate::facts;
use crate::fit::{FitPlan, FitRequest};
use crate::plan::Plan;
use crate::predict::{self, Predicted, Target};
use crate::provenance::{ModelProvenance, Provenance, chosen_notes};
use crate::recordings::{self, Clusters};
use crate::report::{EvaluationReport, RecordingScores};
use crate::rows::{DataPart, Divided};
use crate::samples::Samples;
use crate::skill::with_skill;
use crate::state_file::StateFile;
use crate::subject::Subject;
use crate::work::Work;

pub use given::{GivenModel, GivenRequest, GivenRows};
use passes::Passes;

/// What to evaluate.
#[derive(Debug)]
pub struct EvaluateRequest {
    /// The model, fitted or to be fitted.
    pub model: ModelChoice,
    /// Metrics and groups by name.
    pub metrics: Vec<String>,
    /// The part that is scored; what the model has not seen, if `None`.
    pub part: Option<DataPart>,
    /// What is known of the sensor beyond the dataset's header.
    pub sensor: Option<SensorFile>,
}

/// What is asked for beside the model.
#[derive(Clone, Copy)]
pub(crate) struct Asked<'a> {
    metrics: &'a [String],
    part: Option<DataPart>,
    sensor: Option<&'a SensorFile>,
}

impl EvaluateRequest {
    pub(crate) fn asked(&self) -> Asked<'_> {
        Asked {
            metrics: &self.metrics,
            part: self.part,
            sensor: self.sensor.as_ref(),
        }
    }
}

/// The model: to be fitted, or finished.
#[derive(Debug)]
pub enum ModelChoice {
    /// Fitted on the training part first.
    Fit(FitRequest),
    /// Fitted before.
    Fitted(Box<Model>),
}

/// A finished evaluation.
#[derive(Debug)]
pub struct Evaluated {
    /// The scores and where they come from.
    pub report: EvaluationReport,
    /// What was kept, to be joined with that of other recordings.
    pub state: StateFile,
    /// How the dataset was divided, if it was.
    pub manifest: Option<SplitManifest>,
}

/// Says what [`evaluate`] would do; reads no frame.
///
/// # Errors
/// [`StudyError`] if the request is not valid.
pub fn evaluate_plan(dataset: &Dataset, request: &EvaluateRequest) -> Result<Plan, StudyError> {
    let mut plan = Plan::default();
    let rows = dataset.table().rows();
    plan.step("read", format!("{rows} rows of {}", shown(&dataset.path())));
    let (target, channels, reads_frames) = match &request.model {
        ModelChoice::Fit(fit) => {
            let fit = match folds::of(dataset, fit)? {
                Some(folds) => {
                    folds.refuse_part(request)?;
                    folds.explain(&mut plan);
                    folds.first(fit)?
                }
                None => FitPlan::new(dataset, fit)?,
            };
            plan.step("divide", divided_as(&fit.divided));
            fit.explain(&mut plan);
            let (channels, reads_frames) = (fit.channels.clone(), fit.reads_frames());
            (
                Target::of(dataset, Some(fit.divided), request.part, reads_frames)?,
                channels,
                reads_frames,
            )
        }
        ModelChoice::Fitted(model) => {
            plan.skipped
                .push(Skipped::new("stage:fit", SkipReason::AlreadyThere));
            (
                Target::new(dataset, model, request.part)?,
                model.channels().clone(),
                model.reads_frames(),
            )
        }
    };
    let count = target.rows.len();
    if reads_frames {
        plan.step(
            "decode",
            format!("{count} frames of the part `{}`", target.part.name()),
        );
    } else {
        plan.skipped
            .push(Skipped::new("field:frame", SkipReason::NothingReadsIt));
    }
    let metrics = metrics(dataset, &channels, request.asked())?;
    let ids: Vec<&str> = metrics.kept().iter().map(|metric| metric.id).collect();
    plan.step("predict", format!("{count} samples"));
    plan.step("score", ids.join(", "));
    plan.skipped.extend(metrics.skipped().iter().cloned());
    Ok(plan)
}

/// Evaluates `dataset`: fits the model if that was asked for, predicts what it has not seen, and scores.
///
/// # Errors
/// [`StudyError`] if the request is not valid, the model does not fit the dataset, or the dataset cannot be read.
pub fn evaluate(
    dataset: &Dataset,
    request: &EvaluateRequest,
    work: Work<'_>,
) -> Result<Evaluated, StudyError> {
    match &request.model {
        ModelChoice::Fit(fit) => {
            // Asked before the work: an unknown metric must not cost a fit.
            catalogue::select(request.metrics.iter().map(String::as_str))?;
            if let Some(folds) = folds::of(dataset, fit)? {
                return folds.evaluate((request, fit), work);
            }
            let plan = FitPlan::new(dataset, fit)?;
            if request.part.is_none() {
                plan.divided.require_test()?;
            }
            let fitted = plan.run(work)?;
            let model = &fitted.model;
            let target = Target::of(
                dataset,
                Some(fitted.divided),
                request.part,
                model.reads_frames(),
            )?;
            let predicted = predict::run(dataset, model, &target, work)?;
            let behind = Behind::of(model)?;
            let mut scored = score(
                dataset,
                request.asked(),
                behind,
                (&target, &predicted),
                work.jobs,
            )?;
            let report = &mut scored.report;
            report.provenance.frames_decoded += fitted.frames_decoded;
            report
                .provenance
                .notes
                .extend(left_out_note("training and validation", fitted.left_out));
            Ok(Evaluated {
                manifest: Some(fitted.manifest),
                ..scored
            })
        }
        ModelChoice::Fitted(model) => {
            let target = Target::new(dataset, model, request.part)?;
            let predicted = predict::run(dataset, model, &target, work)?;
            let behind = Behind::of(model)?;
            let scored = score(
                dataset,
                request.asked(),
                behind,
                (&target, &predicted),
                work.jobs,
            )?;
            let manifest = target
                .divided
                .map(|divided| divided.manifest(dataset.table()))
                .transpose()?;
            Ok(Evaluated { manifest, ..scored })
        }
    }
}

fn metrics(
    dataset: &Dataset,
    channels: &Channels,
    asked: Asked<'_>,
) -> Result<MetricPlan, StudyError> {
    let wanted = catalogue::select(asked.metrics.iter().map(String::as_str))?;
    let available: FieldSet = dataset.fields().with(Field::Prediction);
    let facts = facts::of_dataset(dataset, asked.sensor)?;
    Ok(MetricPlan::new(&with_skill(wanted), channels.clone(), available).with_facts(facts))
}

/// What a result says of the model, or the models, behind it.
pub(crate) struct Behind {
    model: ModelProvenance,
    /// Files of models without a seal.
    unsealed: Vec<String>,
    /// What was chosen where a person left it open.
    chosen: Vec<String>,
}

impl Behind {
    pub(crate) fn of(model: &Model) -> Result<Behind, StudyError> {
        Ok(Behind {
            model: ModelProvenance::of(model)?,
            unsealed: Provenance::unsealed_model(model).into_iter().collect(),
            chosen: chosen_notes(model).collect(),
        })
    }
}

/// The scores of what was predicted, with where they come from.
pub(crate) fn score(
    dataset: &Dataset,
    asked: Asked<'_>,
    behind: Behind,
    (target, predicted): (&Target, &Predicted),
    jobs: NonZeroUsize,
) -> Result<Evaluated, StudyError> {
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
) -> Result<Vec<RecordingScores>, StudyError> {
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

fn divided_as(divided: &Divided) -> String {
    let parts = [DataPart::Train, DataPart::Validation, DataPart::Test];
    let counts: Vec<String> = parts
        .iter()
        .map(|part| format!("{} {}", part.name(), divided.rows(*part).len()))
        .collect();
    format!(
        "{}, seed {}: {}",
        divided.spec,
        divided.seed,
        counts.join(", ")
    )
}

/// A note that scores are of samples that the model was fitted on.
fn seen_note(target: &Target) -> Option<String> {
    let divided = target.divided.as_ref()?;
    let is_seen = match target.part {
        DataPart::Train | DataPart::Validation | DataPart::All => true,
        DataPart::Test => false,
    };
    (is_seen && !divided.rows(DataPart::Train).is_empty()).then(|| {
        format!(
            "scored on the part `{}`, which the model has seen: this is no test",
            target.part.name()
        )
    })
}

/// A note that pictures of the test part are, byte for byte, among those that the model was fitted on.
fn copies_note(dataset: &Dataset, target: &Target) -> Option<String> {
    let divided = target.divided.as_ref()?;
    if target.part != DataPart::Test {
        return None;
    }
    let frames = dataset.table().frames();
    let digest = |row: &usize| Some(frames[*row].as_ref()?.digest);
    let parts = [DataPart::Train, DataPart::Validation].map(|part| divided.rows(part));
    let seen: BTreeSet<_> = parts.iter().flatten().filter_map(digest).collect();
    let tested = target.rows.iter().filter_map(digest);
    let copies = tested.filter(|digest| seen.contains(digest)).count();
    (copies > 0).then(|| {
        format!(
            "{copies} of {} pictures of the test part are, byte for byte, also fitted on: the scores flatter (taceva check, TAC002 and TAC007)",
            target.rows.len()
        )
    })
}

/// A note that the model was fitted before rows were added, so that the parts named here are larger than those it was fitted on.
fn stage_note(dataset: &Dataset, fitted_on: &str) -> Option<String> {
    let mut stages = dataset.header().stages();
    let (_, rows) = stages.find(|(digest, _)| digest.to_string() == fitted_on)?;
    let now = dataset.header().table.rows;
    (rows < now).then(|| {
        format!("the model was fitted when the dataset had {rows} of its {now} samples; the parts are those of now")
    })
}

/// A note that a model was fitted on other data, of which nobody can say whether it held these samples too.
fn elsewhere_note(target: &Target, model: &ModelProvenance) -> Option<String> {
    let is_known = target.divided.is_some() || model.origin.is_some();
    (!is_known).then(|| {
        format!(
            "every sample is scored, because the model was fitted on other data, {}; samples that both hold, as an export or a second import of one recording does, are not distinguished",
            model.fitted_on
        )
    })
}

fn left_out_note(part: &str, count: usize) -> Option<String> {
    (count > 0).then(|| {
        format!("{count} samples of the part {part} lack a label or a frame and were left out")
    })
}

/// What to do where the scored part has too few contact points for any interval.
fn few_points_note(points: Option<&[&str]>) -> Option<String> {
    let distinct: BTreeSet<&str> = points?.iter().copied().collect();
    (distinct.len() < 5).then(|| {
        format!(
            "scored on {} contact points, too few for intervals; test on more of them: --split 'by-point 50/10/40'",
            distinct.len()
        )
    })
}
