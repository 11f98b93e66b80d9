//! Tasks of models: their card entries, and the frames that a sample reads.

use taceva_core::{counted, shown};
use taceva_dataset::Task;
use taceva_models::{FeatureSpec, FrameWindow, ModelSettings, TaskCard};

use crate::error::EvaluateError;

/// Entry of `task` in a model card.
pub(crate) fn task_card(task: &Task) -> TaskCard {
    TaskCard {
        name: task.name.clone(),
        kind: task.kind.name().to_owned(),
        names: task.names.clone(),
        positive: task.positive.clone(),
        cluster: task.cluster.clone(),
    }
}

/// Window of consecutive frames that `settings` state; `None` for single frames.
///
/// # Errors
/// [`EvaluateError::Setting`] for a number out of range.
pub(crate) fn window_of(settings: &ModelSettings) -> Result<Option<FrameWindow>, EvaluateError> {
    let is_own = |word: &String| word.starts_with("window=") || word.starts_with("stride=");
    let words: Vec<String> = settings.words().filter(is_own).collect();
    let own = ModelSettings::parse(words.iter().map(String::as_str))?;
    Ok(FeatureSpec::from_settings(&own)?.window)
}

/// Note on the frames of each sample of `task`.
pub(crate) fn in_words(window: FrameWindow, task: &Task) -> String {
    format!(
        "each sample is predicted from {} with stride {} and their changes: the frame of the sample and earlier frames of the same `{}`",
        counted(window.frames() as usize, "frame"),
        window.stride(),
        shown(&task.cluster)
    )
}
