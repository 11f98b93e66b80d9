//! Stages from the recording of a study to the report: fit, predict and score. Each stage reads only the presses that are planned for it.

mod context;
mod gratings;
mod learnt;
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
use taceva_models::Model;
use taceva_protocol::PhaseKind;

use taceva_acquire::{PlannedScene, PlannedStudy};
use taceva_evaluate::{
    Bounded, Context, Divided, Note, Predicted, ScoredRows, StateFile, add_division,
    add_predictions, calibration, depth_zeros, device_warnings, over_seeds as scores_over_seeds,
    protocol_words, provenance_of, reduced, samples_of, subject_of,
};
use taceva_results::Provenance;

use crate::error::StudyError;
use crate::finished::FinishedStudy;
use crate::models::classifier;
pub(crate) use context::RunContext;
use gratings::PredictedSpacings;
use learnt::Learnt;
use phase_rows::PhaseRows;
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
        save_model(learnt.model(), path)?;
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
    // An interrupted run of another version may have left more states.
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
    let behind = learnt.as_ref().map(|learnt| learnt.behind(dataset));
    let behind = behind.transpose()?;
    notes.extend(behind.iter().flat_map(|behind| behind.notes.clone()));
    let divided = learnt.as_ref().and_then(Learnt::division);
    let folds = divided.filter(|divided| !divided.folds.is_empty());
    notes.extend(
        folds
            .and_then(|folds| folds.split.note.clone())
            .map(Note::Split),
    );
    let frames_decoded = [
        learnt.as_ref().map(Learnt::frames_decoded),
        predicted
            .as_ref()
            .map(|(predicted, _)| predicted.frames_decoded),
        spacings.as_ref().map(|spacings| spacings.frames_decoded),
    ];
    let provenance = Provenance {
        model: behind.map(|behind| behind.model),
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
    if let Some(folds) = folds {
        add_division(&mut samples, &rows, folds);
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

/// Writes the state of a group of rows to `path`. Bundles of the run contain this file.
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

/// Writes the model of a study to `path`. Bundles of the run contain this file.
fn save_model(model: &Model, path: &Path) -> Result<(), StudyError> {
    let failed = |problem: String| StudyError::RunFolder {
        path: path.to_owned(),
        problem,
    };
    std::fs::create_dir_all(parent_of(path)).map_err(|error| failed(error.to_string()))?;
    model.save(path).map_err(|error| failed(error.to_string()))
}
