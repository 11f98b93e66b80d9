//! Tasks of joined recordings, whose definitions must agree.

use super::{Dataset, unlike};
use crate::error::DatasetError;
use crate::task::Task;

/// Tasks of all recordings, each once. A recording may lack a task of another one.
///
/// # Errors
/// [`DatasetError::Unlike`] if two recordings define a task differently, because a position in other names is another class.
pub(super) fn shared_tasks(recordings: &[Dataset]) -> Result<Vec<Task>, DatasetError> {
    let mut known: Vec<(&Dataset, &Task)> = Vec::new();
    for recording in recordings {
        for own in recording.table.tasks() {
            let task = own.task();
            match known.iter().find(|(_, other)| other.name == task.name) {
                None => known.push((recording, task)),
                Some((_, other)) if other.definition() == task.definition() => {}
                Some((one, other)) => {
                    let problem = format!(
                        "the task `{}` in the first recording and `{}` in the second differ; evaluate them separately",
                        other.definition(),
                        task.definition()
                    );
                    return Err(unlike(one, recording, problem));
                }
            }
        }
    }
    Ok(known.into_iter().map(|(_, task)| task.clone()).collect())
}
