//! Definition of a task of poses, from the thresholds that a dataset or a request states.

use taceva_core::shown;
use taceva_dataset::PoseThresholds;
use taceva_tasks::pose::{PoseTask, Thresholds};

use crate::error::EvaluateError;

/// Definition of the task `name` with the thresholds `of`.
///
/// # Errors
/// [`EvaluateError::Request`] for thresholds that are not positive numbers in ascending order.
pub(crate) fn pose_definition(
    name: &str,
    of: Option<&PoseThresholds>,
) -> Result<PoseTask, EvaluateError> {
    let Some(of) = of else {
        return Ok(PoseTask::default());
    };
    let [translation, rotation] =
        [&of.t, &of.r].map(|texts| texts.iter().map(String::as_str).collect::<Vec<_>>());
    let thresholds = Thresholds::new(&translation, &rotation);
    let thresholds = thresholds
        .map_err(|error| EvaluateError::Request(format!("task `{}`: {error}", shown(name))))?;
    Ok(PoseTask::default().with_thresholds(thresholds))
}
