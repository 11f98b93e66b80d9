//! Models that predict the labels of a task.

use taceva_core::shown;
use taceva_dataset::{Dataset, Task, TaskKind};
use taceva_models::{Model, ModelSettings};

use crate::error::EvaluateError;
use crate::fit::FitRequest;

/// Models that predict one of the labels of the training part.
pub const CLASSIFIERS: [&str; 8] = [
    "lda",
    "linfa/logistic",
    "smartcore/knn-classifier",
    "cnn",
    "resnet10",
    "resnet18",
    "resnet34",
    "auto",
];

/// Number of entries at the start of [`CLASSIFIERS`] that cannot predict numbers.
const CLASSIFIERS_ALONE: usize = 3;

/// Name of the setting that switches a model between numbers and classes.
const HEAD: &str = "head";

/// Default model for the task called `name`.
pub fn usual_model(dataset: &Dataset, name: &str) -> &'static str {
    let mut tasks = dataset.tasks().iter().map(|own| own.task());
    let task = tasks.find(|task| task.name == name);
    usual(task.map_or(TaskKind::Class, |task| task.kind))
}

/// Default model for a task of `kind`.
fn usual(kind: TaskKind) -> &'static str {
    match kind {
        TaskKind::Pose => "ridge",
        TaskKind::Depth => "cnn",
        _ => "lda",
    }
}

/// Request for the fit of a model that predicts the labels of `task`: classes, or the numbers of a pose or of a depth map.
///
/// # Errors
/// [`EvaluateError::Request`] for a model of numbers with a task of classes, or the reverse.
pub(crate) fn as_predictor(fit: FitRequest, task: &Task) -> Result<FitRequest, EvaluateError> {
    let labels = match task.kind {
        TaskKind::Pose => "poses",
        TaskKind::Depth => "depth maps",
        _ => return as_classifier(fit, task),
    };
    let model = fit.model.name();
    // The other classifiers predict numbers too.
    let of_classes = CLASSIFIERS.iter().take(CLASSIFIERS_ALONE);
    if of_classes.copied().any(|classifier| classifier == model) {
        let usual = usual(task.kind);
        return Err(EvaluateError::Request(format!(
            "task `{}`: {} predicts classes, but {labels} are numbers; choose another model, such as --model {usual}",
            shown(&task.name),
            shown(model)
        )));
    }
    Ok(fit)
}

/// Request for the fit of a model that predicts the classes of `task`.
///
/// # Errors
/// [`EvaluateError::Request`] for a model that is not one of [`CLASSIFIERS`].
fn as_classifier(fit: FitRequest, task: &Task) -> Result<FitRequest, EvaluateError> {
    let model = fit.model.name();
    if !CLASSIFIERS.contains(&model) {
        return Err(EvaluateError::Request(format!(
            "task `{}`: {} predicts numbers, expected a classifier, such as --model {}",
            shown(&task.name),
            shown(model),
            CLASSIFIERS.join(" or --model ")
        )));
    }
    if !fit.model.setting_keys().contains(&HEAD) {
        return Ok(fit);
    }
    let words = fit.settings.words();
    let words = words.filter(|word| !word.starts_with("head="));
    let words: Vec<String> = words.chain([format!("{HEAD}=classes")]).collect();
    Ok(FitRequest {
        settings: ModelSettings::parse(words.iter().map(String::as_str))?,
        ..fit
    })
}

/// Dataset with the classes of the model's task as labels; `None` if the dataset lacks the task.
///
/// # Errors
/// [`EvaluateError::Unsuited`] for a task of the same name with other classes.
pub fn labelled_for(dataset: &Dataset, model: &Model) -> Result<Option<Dataset>, EvaluateError> {
    let Some(card) = &model.card().provenance.task else {
        return Ok(None);
    };
    let mut tasks = dataset.tasks().iter().map(|own| own.task());
    let Some(task) = tasks.find(|task| task.name == card.name) else {
        return Ok(None);
    };
    if task.names != card.names {
        return Err(EvaluateError::Unsuited(format!(
            "the model predicts the classes {} of the task `{}`, but the dataset has {}: import the dataset with the same `names` in its map",
            card.names.join(", "),
            shown(&card.name),
            task.names.join(", ")
        )));
    }
    Ok(Some(dataset.of_task(&card.name)?))
}
