//! Stages from the recording of a study to its report: fit, predict and score. Each stage reads its planned presses.

mod context;
mod gratings;
mod phase_rows;
mod pose;
mod score;
mod shape;
mod slip;
mod task;

use std::io;
use std::path::{Path, PathBuf};

use taceva_core::Field;
use taceva_dataset::{Dataset, RecordedSessions, frame_retries, frozen_frames};
use taceva_files::{parent_of, replace};
use taceva_metrics::Evaluation;
use taceva_models::{Checkpoints, Model};
use taceva_protocol::PhaseKind;

use taceva_acquire::{PlannedScene, PlannedStudy};
use taceva_evaluate::{
    Bounded, Context, Note, ScoredRows, calibration, choices, depth_zeros, device_warnings, reduced,
};
use taceva_evaluate::{CachedStage, Key};
use taceva_evaluate::{DataPart, Divided, Need, usable};
use taceva_evaluate::{EvaluateError, StateFile};
use taceva_evaluate::{FitPlan, FitRequest, Recipe};
use taceva_evaluate::{Predicted, Predictor, Target, predicted_numbers, predicted_table};
use taceva_evaluate::{
    add_predictions, model_provenance, over_seeds as scores_over_seeds, protocol_words,
    provenance_of, samples_of, subject_of,
};
use taceva_results::Provenance;

use crate::error::StudyError;
use crate::finished::{FinishedStudy, FittedStudy};
use crate::models::{classifier, fit_request, model_file};
pub(crate) use context::RunContext;
use gratings::PredictedSpacings;
use phase_rows::{PhaseRows, seen};
use score::{Scores, StudyScores, score};

/// Evaluates `recording` of `study`, and returns it with the report and the model.
pub(crate) fn assess(
    scene: &PlannedScene,
    study: &PlannedStudy,
    recording: Dataset,
    context: RunContext<'_>,
) -> Result<FinishedStudy, StudyError> {
    let dataset = &recording;
    let phase_rows = PhaseRows::new(study, dataset);
    let first = scene.seeds.first().copied();
    let learnt = Learnt::new(scene, study, dataset, &phase_rows, context, first)?;
    if let (Some(learnt), Some(path)) = (&learnt, context.model) {
        save_model(&learnt.model, path)?;
    }
    let predicted = learnt
        .as_ref()
        .map(|learnt| learnt.predict(study, dataset, &phase_rows, context))
        .transpose()?;
    let classifier = classifier(scene, context.models)?;
    let spacings = phase_rows
        .reads_spacings()
        .then(|| {
            PredictedSpacings::of(
                dataset,
                phase_rows.rows(PhaseKind::Gratings),
                &classifier,
                context,
            )
        })
        .transpose()?;
    let scores_of = |predicted: Option<&(Predicted, Vec<usize>)>| {
        score(&Scores {
            scene,
            study,
            dataset,
            phase_rows: &phase_rows,
            predicted,
            predicted_spacings: spacings.as_ref(),
            jobs: context.work.jobs,
        })
    };
    let StudyScores {
        evaluation,
        mut notes,
        states,
        phases,
    } = scores_of(predicted.as_ref())?;
    let state_path = |number: usize| {
        let mut name = context.states.as_os_str().to_owned();
        name.push(format!(".{number:02}.json"));
        PathBuf::from(name)
    };
    for (number, state) in states.iter().enumerate() {
        write_state(state, &state_path(number))?;
    }
    // An interrupted run of another version may have left more.
    let mut number = states.len();
    while std::fs::remove_file(state_path(number)).is_ok() {
        number += 1;
    }
    let mut others = Vec::new();
    for seed in scene.seeds.iter().skip(1) {
        let learnt = Learnt::new(scene, study, dataset, &phase_rows, context, Some(*seed))?;
        if let Some(learnt) = learnt {
            let predicted = learnt.predict(study, dataset, &phase_rows, context)?;
            others.push(scores_of(Some(&predicted))?.evaluation);
        }
    }
    let over_seeds = (!others.is_empty()).then(|| {
        let evaluations: Vec<&Evaluation> = [&evaluation].into_iter().chain(&others).collect();
        scores_over_seeds(&scene.seeds, &evaluations)
    });
    notes.extend(spacings.as_ref().map(|_| Note::Spacings(classifier.note())));
    notes.extend(phase_rows.shortfall());
    notes.extend(reduced(dataset));
    notes.extend(depth_zeros(dataset));
    notes.extend(device_warnings(dataset));
    let sessions = RecordedSessions::of(dataset.path());
    notes.extend(sessions.map(|sessions| Note::Sessions(sessions.note)));
    let retries = frame_retries(dataset.path());
    notes.extend((retries > 0).then_some(Note::FramesRetried(retries)));
    let frozen = frozen_frames(dataset.path());
    notes.extend((frozen > 0).then_some(Note::FramesFrozen(frozen)));
    let mut beyond = Bounded::default();
    if let Some((predicted, rows)) = &predicted {
        beyond = predicted.bounded(0..predicted.rows());
        notes.extend(predicted.beyond());
        let calibrated = phase_rows.rows(PhaseKind::Calibration);
        let counts = |row: usize| calibrated.binary_search(&row).is_ok();
        let jobs = context.work.jobs;
        notes.extend(calibration(dataset, predicted, rows, counts, jobs)?);
    }
    notes.extend(learnt.iter().flat_map(|learnt| choices(&learnt.model)));
    let divided = learnt.as_ref().and_then(|learnt| learnt.divided.as_ref());
    let frames_decoded = [
        learnt.as_ref().map(|learnt| learnt.frames_decoded),
        predicted
            .as_ref()
            .map(|(predicted, _)| predicted.frames_decoded),
        spacings.as_ref().map(|spacings| spacings.frames_decoded),
    ];
    let provenance = Provenance {
        model: learnt
            .as_ref()
            .map(|learnt| model_provenance(&learnt.model))
            .transpose()?,
        split: divided.map(|divided| divided.spec.to_string()),
        seed: Some(scene.scene.seed),
        phases,
        samples: divided.map(Divided::counts).unwrap_or_default(),
        frames_decoded: frames_decoded.into_iter().flatten().sum(),
        ..provenance_of(dataset)
    };
    let rows = dataset.all_rows();
    let mut samples = samples_of(dataset, &rows)?;
    if let Some(parts) = phase_rows.protocol() {
        samples.insert_protocol(protocol_words(&rows, &parts));
    }
    if let Some((predicted, of_rows)) = &predicted {
        add_predictions(&mut samples, &rows, predicted, of_rows);
    }
    if let Some(spacings) = &spacings {
        samples.push_numbers("spacing_predicted_mm", spacings.in_millimetres(&rows));
    }
    let digest = Field::FrameDigest.name();
    if let Some(digests) = dataset.table().as_text(digest) {
        samples.push_words(digest, digests);
    }
    let tasks = [
        slip::of(scene, dataset, &phase_rows, context)?,
        shape::of(scene, study, dataset, &phase_rows, predicted.as_ref())?,
        pose::of(scene, study, dataset, &phase_rows, context)?,
    ];
    let mut subject = subject_of(dataset);
    if let Some((unit, note)) = phase_rows.measured_unit() {
        subject.serial = unit;
        notes.push(note);
    }
    let context = Context {
        notes,
        over_seeds,
        samples: Some(samples),
        ..Context::new(subject, provenance)
    };
    let rows = ScoredRows::Finished(Box::new(evaluation));
    let mut report = taceva_evaluate::assess(rows, beyond, context)?.report;
    for task in tasks.into_iter().flatten() {
        task.add_to(&mut report);
    }
    let fitted = learnt.map(|learnt| learnt.into_fitted(dataset, &phase_rows));
    Ok(FinishedStudy {
        report,
        fitted,
        dataset: recording,
    })
}

/// Writes the state of a group of rows, for the bundles of the run.
fn write_state(state: &StateFile, path: &Path) -> Result<(), StudyError> {
    let failed = |error: io::Error| StudyError::RunFolder {
        path: path.to_owned(),
        problem: error.to_string(),
    };
    std::fs::create_dir_all(parent_of(path)).map_err(failed)?;
    replace(path, |staged| -> io::Result<()> {
        state.write(&mut std::fs::File::create(staged)?)
    })
    .map_err(failed)
}

/// Writes the model of a study to `path`, for the bundles of the run.
fn save_model(model: &Model, path: &Path) -> Result<(), StudyError> {
    let failed = |problem: String| StudyError::RunFolder {
        path: path.to_owned(),
        problem,
    };
    std::fs::create_dir_all(parent_of(path)).map_err(|error| failed(error.to_string()))?;
    model.save(path).map_err(|error| failed(error.to_string()))
}

/// Fitted or opened model of a study, and the split of its fit.
struct Learnt {
    model: Model,
    divided: Option<Divided>,
    frames_decoded: u64,
}

impl Learnt {
    /// Fits or opens the model that the plan needs, with `seed` if given; `None` if no metric reads predictions.
    fn new(
        scene: &PlannedScene,
        study: &PlannedStudy,
        dataset: &Dataset,
        phase_rows: &PhaseRows<'_>,
        context: RunContext<'_>,
        seed: Option<u64>,
    ) -> Result<Option<Learnt>, EvaluateError> {
        if !phase_rows.reads_predictions() {
            return Ok(None);
        }
        if let Some(file) = model_file(study) {
            let model = context
                .models
                .open(&scene.text.folder.join(file))
                .map_err(|error| EvaluateError::Request(error.to_string()))?;
            return Ok(Some(Learnt {
                divided: Divided::by_model(dataset, &model)?,
                model,
                frames_decoded: 0,
            }));
        }
        let Some(request) = fit_request(study, scene.scene.seed, context.models) else {
            return Ok(None);
        };
        let mut request = FitRequest {
            channels: phase_rows.predicted_channels(),
            ..request?
        };
        if let Some(seed) = seed {
            request = request.with_seed(seed)?;
        }
        let recipe = Recipe::of(&request)?;
        let divided = phase_rows.divided(&request)?;
        let mut plan = FitPlan::on(dataset, &request, recipe, divided.clone())?;
        // Only one training keeps a checkpoint; the cache holds the finished ones of other seeds.
        if seed == scene.seeds.first().copied() {
            plan.keep_checkpoints(Checkpoints::at(context.checkpoint.to_owned()));
        }
        let key = Key::of(CachedStage::Fit)
            .part("dataset", &dataset.digest().to_string())
            .whole("request", &request)
            .whole("divided", &divided)
            .finish();
        let frames_decoded = plan.frames_to_decode();
        let model = context
            .cache
            .value(&key, || plan.run(context.work).map(|fitted| fitted.model))?;
        Ok(Some(Learnt {
            model,
            divided: Some(divided),
            frames_decoded,
        }))
    }

    /// The model with the calibration samples that it has not seen.
    fn into_fitted(self, dataset: &Dataset, phase_rows: &PhaseRows<'_>) -> FittedStudy {
        let seen = self.divided.as_ref().map_or_else(Vec::new, seen);
        let mut rows = phase_rows.rows(PhaseKind::Calibration);
        rows.retain(|row| seen.binary_search(row).is_err());
        let need = Need {
            frame: true,
            labels: None,
        };
        let usable = usable(dataset, &rows, need);
        let part = match self.divided {
            Some(_) => DataPart::Test,
            None => DataPart::All,
        };
        FittedStudy {
            model: self.model,
            unseen: Target {
                part,
                left_out: rows.len() - usable.len(),
                rows: usable,
                divided: self.divided,
            },
        }
    }

    /// Predictions of all rows that a metric reads, except the rows of the fit.
    fn predict(
        &self,
        study: &PlannedStudy,
        dataset: &Dataset,
        phase_rows: &PhaseRows<'_>,
        RunContext { work, cache, .. }: RunContext<'_>,
    ) -> Result<(Predicted, Vec<usize>), EvaluateError> {
        let seen = self.divided.as_ref().map_or_else(Vec::new, seen);
        let phases = phase_rows.predicted_phases();
        let mut rows: Vec<usize> = phases
            .into_iter()
            .flat_map(|kind| phase_rows.rows(kind))
            .chain(phase_rows.of_other_units().iter().copied())
            .collect();
        rows.sort_unstable();
        rows.dedup();
        rows.retain(|row| seen.binary_search(row).is_err());
        let need = Need {
            frame: self.model.reads_features(),
            labels: None,
        };
        let usable = usable(dataset, &rows, need);
        if usable.is_empty() {
            return Err(EvaluateError::Request(format!(
                "study `{}` has no sample to predict",
                study.plan.name
            )));
        }
        let target = Target {
            part: DataPart::All,
            left_out: rows.len() - usable.len(),
            rows: usable,
            divided: None,
        };
        let key = Key::of(CachedStage::Predict)
            .part("dataset", &dataset.digest().to_string())
            .part("model", &self.model.digest()?)
            .whole("rows", &target.rows)
            .finish();
        let numbers = cache.value(&key, || {
            predicted_numbers(dataset, &self.model, &target, work)
        })?;
        let predicted = predicted_table(dataset, Predictor::of(&self.model), &target, &numbers)?;
        Ok((predicted, target.rows))
    }
}
