//! Fit of a model to a task of a dataset.

use taceva_core::{Field, shown};
use taceva_dataset::Dataset;
use taceva_models::{Checkpoints, SplitKind, SplitSpec};

use super::task::check_split;
use crate::classifiers::as_predictor;
use crate::error::EvaluateError;
use crate::fit::{FitRequest, Fitted, fit};
use crate::work::Work;

/// Fits a model to the labels of the task called `name`. The card of the model stores the task. Without a stated split, clusters are divided into
/// training, validation and test parts.
///
/// # Errors
/// [`EvaluateError`] for an unknown task, or a model that cannot predict a task of this kind. A split that separates samples of one cluster, or fits
/// several models, is also an error. Otherwise errors of [`fit`].
pub fn fit_task(
    dataset: &Dataset,
    name: &str,
    request: FitRequest,
    checkpoints: Option<Checkpoints>,
    work: Work<'_>,
) -> Result<Fitted, EvaluateError> {
    let of_task = dataset.of_task(name)?;
    let task = of_task.labelled_by();
    let task = task.expect("BUG: the labels are those of the task");
    let mut request = as_predictor(request, task)?;
    let own = match task.cluster == Field::Point.name() {
        true => "by-point".to_owned(),
        false => format!("by-column:{}", task.cluster),
    };
    let split = request.split.take().unwrap_or_else(|| own.clone());
    let spec: SplitSpec = split.parse()?;
    match spec.kind {
        SplitKind::All => {}
        SplitKind::Folds(_) | SplitKind::LeaveOneRecordingOut => {
            return Err(EvaluateError::Request(format!(
                "task `{}`: the split `{}` fits several models, expected `{own}`, or `all` for a model of all samples; `taceva evaluate --task {}` \
                 scores by folds",
                shown(name),
                shown(&split),
                shown(name)
            )));
        }
        _ => check_split(&split, task)?,
    }
    request.split = Some(split);
    request.channels.clear();
    fit(&of_task, &request, checkpoints, work)
}
