//! Carrying one task out.

use std::collections::BTreeMap;

use taceva_core::{ErrorKind, shown};
use taceva_dataset::SensorFile;
use taceva_models::{ChosenBy, Model, Models};
use taceva_report::Study;
use taceva_study::{
    EvaluateRequest, EvaluationReport, ModelChoice, StudyError, Work, evaluate, fit,
};

use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::recording::opened;
use crate::result::{PointErrors, TaskResult, ValidationError};
use crate::task::Task;

/// What came of a task.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// Its result is there.
    Scored,
    /// It cannot be carried out, for this reason.
    Failed(String),
    /// It was asked to stop, and left nothing.
    Stopped,
}

/// What tasks of a sweep have in common.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Common<'a> {
    pub(crate) folder: &'a SweepFolder,
    pub(crate) models: &'a Models,
    pub(crate) metrics: &'a [String],
    pub(crate) sensor: Option<&'a SensorFile>,
}

/// Fits and scores `task`, and writes its result.
///
/// # Errors
/// [`SweepError`] if it cannot be carried out; nothing is written then.
pub(crate) fn carry_out(task: &Task, common: Common<'_>, work: Work<'_>) -> Result<(), SweepError> {
    let (dataset, digest) = opened(&task.path)?;
    let digest = digest.to_string();
    if digest != task.digest {
        return Err(SweepError::Kept {
            path: task.path.clone(),
            problem: format!(
                "the recording is another one than when the sweep was planned: {digest}, expected {}; start the sweep again",
                task.digest
            ),
        });
    }
    let request = task.request(common.models)?;
    let fitted = fit(&dataset, &request, None, work)?;
    let asked = |model| EvaluateRequest {
        model: ModelChoice::Fitted(Box::new(model)),
        metrics: common.metrics.to_vec(),
        part: None,
        sensor: common.sensor.cloned(),
    };
    let mut result = TaskResult::new(task.key.clone());
    let model = fitted.model;
    result.model_digest = model.digest().map_err(StudyError::from)?;
    (result.chosen_by, result.validation) = validation(&model);
    let mut evaluated = evaluate(&dataset, &asked(model), work)?;
    evaluated.report.provenance.frames_decoded += fitted.frames_decoded;
    let text = sealed(&evaluated.report)?;
    let study = Study::read(&text);
    let study = study.map_err(|error| unexpected(task, &error))?;
    let study = study.first().ok_or_else(|| unexpected(task, &"no study"))?;
    result = result.with_scores(study);
    result.errors = errors(&evaluated.report).map_err(|error| unexpected(task, &error))?;
    // The evaluation first: where the result is, everything is.
    let folder = common.folder;
    folder.write(&folder.evaluation(&task.key), text.as_bytes())?;
    folder.write(&folder.result(&task.key), result.text()?.as_bytes())
}

/// Whether the work was asked to stop.
pub(crate) fn is_stop(error: &SweepError) -> bool {
    let kind = match error {
        SweepError::Study(error) => error.kind(),
        SweepError::Dataset(error) => error.kind(),
        _ => return false,
    };
    kind == ErrorKind::Interrupted
}

fn unexpected(task: &Task, problem: &dyn std::fmt::Display) -> SweepError {
    SweepError::Kept {
        path: task.path.clone(),
        problem: format!(
            "its evaluation cannot be read back: {}",
            shown(&problem.to_string())
        ),
    }
}

/// The evaluation as `taceva evaluate --format json` writes it.
fn sealed(report: &EvaluationReport) -> Result<String, SweepError> {
    let wrong = |problem: String| SweepError::Kept {
        path: "evaluation".into(),
        problem,
    };
    let text = serde_json::to_string_pretty(report).map_err(|error| wrong(error.to_string()))?;
    taceva_seal::json::seal(&text).map_err(|error| wrong(error.to_string()))
}

/// What settings were chosen by, and the error of each channel there.
fn validation(model: &Model) -> (String, Vec<ValidationError>) {
    let card = model.card();
    let by = match card.choice.by {
        ChosenBy::Nobody | ChosenBy::Validation | ChosenBy::Likelihood => "validation part",
        ChosenBy::LeaveOneGroupOut => "groups of the training part, left out one by one",
        ChosenBy::LeaveOneOut => "samples of the training part, left out one by one",
        ChosenBy::TenFolds => "ten folds of the training part",
    };
    let channels = card.channels.iter().zip(&card.choice.channels);
    let errors = channels.filter_map(|(channel, choice)| {
        Some(ValidationError {
            channel: channel.name.clone(),
            unit: channel.unit.to_string(),
            rmse: choice.rmse?,
        })
    });
    (by.to_owned(), errors.collect())
}

/// The absolute errors of each channel, summed by contact point, or sample by sample where no contact point is known.
fn errors(report: &EvaluationReport) -> Result<PointErrors, csv::Error> {
    let Some(samples) = &report.samples else {
        return Ok(BTreeMap::new());
    };
    let mut text = Vec::new();
    samples.write(&mut text, str::to_owned)?;
    let mut table = csv::Reader::from_reader(text.as_slice());
    let names: Vec<String> = table.headers()?.iter().map(str::to_owned).collect();
    let position = |name: &str| names.iter().position(|known| known == name);
    let channels: Vec<(&str, usize, usize)> = names
        .iter()
        .filter_map(|name| {
            let predicted = position(&format!("{name}_predicted"))?;
            Some((name.as_str(), position(name)?, predicted))
        })
        .collect();
    let point = position("point_id").or_else(|| position("id")).unwrap_or(0);
    let mut sums: BTreeMap<String, BTreeMap<String, (u64, f64)>> = BTreeMap::new();
    for record in table.records() {
        let record = record?;
        let number = |at: usize| {
            record
                .get(at)?
                .parse::<f64>()
                .ok()
                .filter(|value| value.is_finite())
        };
        for (channel, truth, predicted) in &channels {
            let (Some(truth), Some(predicted)) = (number(*truth), number(*predicted)) else {
                continue;
            };
            let of_channel = sums.entry((*channel).to_owned()).or_default();
            let cell = of_channel
                .entry(record.get(point).unwrap_or_default().to_owned())
                .or_default();
            cell.0 += 1;
            cell.1 += (truth - predicted).abs();
        }
    }
    let listed = |points: BTreeMap<String, (u64, f64)>| {
        let points = points.into_iter();
        points.map(|(point, (n, sum))| (point, n, sum)).collect()
    };
    Ok(sums
        .into_iter()
        .map(|(channel, points)| (channel, listed(points)))
        .collect())
}
