//! Execution of one task.

mod errors;
mod labels;
mod shard;

use taceva_core::ErrorKind;
use taceva_dataset::{Digest, SensorFile};
use taceva_evaluate::{EvaluateError, EvaluateRequest, ModelChoice, Work, evaluate, fit};
use taceva_models::{ChosenBy, Model, Models};
use taceva_results::EvaluationReport;

use crate::error::SweepError;
use crate::folder::SweepFolder;
use crate::grid::build_of;
use crate::recording::opened;
use crate::result::{TaskResult, ValidationError};
use crate::task::Task;
use crate::task_list::TaskList;
use errors::errors;

/// Outcome of a task.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// The result is stored in the folder.
    Scored,
    /// The task failed, for this reason.
    Failed(String),
    /// The task was cancelled and stored nothing.
    Stopped,
}

/// State that tasks of a sweep share.
#[derive(Clone, Copy)]
pub(crate) struct Common<'a> {
    pub(crate) folder: &'a SweepFolder,
    pub(crate) models: &'a Models,
    pub(crate) list: &'a TaskList,
    pub(crate) sensor: Option<&'a SensorFile>,
}

/// Fits and scores `task`, and writes its result.
///
/// # Errors
/// [`SweepError`] if the task fails. No result is written in this case.
pub(crate) fn carry_out(task: &Task, common: Common<'_>, work: Work<'_>) -> Result<(), SweepError> {
    if let Some(tables) = &common.list.tables {
        return shard::carry_out(task, tables, common, work);
    }
    if let Some(tables) = &common.list.label_tables {
        return shard::carry_out_labels(task, tables, common, work);
    }
    let (dataset, digest) = opened(&task.path, common.list.view.as_deref())?;
    let digest = digest.to_string();
    if digest != task.digest {
        return Err(SweepError::Changed {
            path: task.path.clone(),
            problem: format!(
                "the recording has changed since the sweep was planned: digest {digest}, expected {}",
                task.digest
            ),
        });
    }
    let build = build_of(&task.model, common.models)?;
    if build != task.plugin {
        let said = |build: &Option<String>| build.clone().unwrap_or_else(|| "no plugin".to_owned());
        return Err(SweepError::Changed {
            path: task.model.clone().into(),
            problem: format!(
                "the plugin was rebuilt since the sweep was planned: {}, expected {}",
                said(&build),
                said(&task.plugin)
            ),
        });
    }
    if let Some(labels) = &task.labels {
        return labels::carry_out(task, labels, &dataset, common, work);
    }
    let request = task.request(common.models)?;
    let fitted = fit(&dataset, &request, None, work)?;
    let asked = |model| EvaluateRequest {
        model: ModelChoice::Fitted(Box::new(model)),
        metrics: common.list.metrics.clone(),
        part: None,
        is_independent: false,
        sensor: common.sensor.cloned(),
    };
    let mut result = TaskResult::new(task.key.clone());
    let model = fitted.model;
    result.model_digest = model.digest().map_err(EvaluateError::from)?;
    (result.chosen_by, result.validation) = validation(&model);
    let mut evaluated = evaluate(&dataset, &asked(model), work)?;
    evaluated.report.provenance.frames_decoded += fitted.frames_decoded;
    let text = sealed(&evaluated.report)?;
    result = result.with_scores(&evaluated.report);
    result.errors = errors(&evaluated.report, dataset.table().channels());
    result.evaluation = Digest::of(text.as_bytes()).to_string();
    // The evaluation is written first, so that every result has one.
    let folder = common.folder;
    folder.write(&folder.evaluation(&task.key), text.as_bytes())?;
    folder.write(&folder.result(&task.key), result.text()?.as_bytes())
}

/// True if the error is a cancellation.
pub(crate) fn is_stop(error: &SweepError) -> bool {
    let kind = match error {
        SweepError::Study(error) => error.kind(),
        SweepError::Dataset(error) => error.kind(),
        _ => return false,
    };
    kind == ErrorKind::Interrupted
}

/// Evaluation as sealed JSON, as written by `taceva evaluate --format json`.
pub(crate) fn sealed(report: &EvaluationReport) -> Result<String, SweepError> {
    taceva_results::sealed(report).map_err(|error| SweepError::Kept {
        path: "evaluation".into(),
        problem: error.to_string(),
    })
}

/// Name of the samples on which settings were chosen, and the error of each channel on these samples.
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
            unit: channel.unit,
            rmse: choice.rmse?,
        })
    });
    (by.to_owned(), errors.collect())
}
