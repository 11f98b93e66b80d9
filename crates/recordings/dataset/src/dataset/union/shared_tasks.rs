//! Tasks of joined recordings, whose definitions must agree.

use crate::table::TaskColumn;
use crate::task::Task;

/// Two recordings that define a task differently.
pub(super) struct OtherDefinition {
    /// Indices of both recordings among the joined recordings.
    pub(super) recordings: [usize; 2],
    /// Both definitions, in words.
    pub(super) problem: String,
}

/// A task, and the position of the first recording that has it.
struct Known<'a> {
    recording: usize,
    task: &'a Task,
}

/// Tasks of all recordings, each once. A recording may lack a task of another recording.
///
/// # Errors
/// [`OtherDefinition`] if two recordings define a task differently, because the same position in another list of names is another class.
pub(super) fn shared_tasks<'a>(
    recordings: impl Iterator<Item = &'a [TaskColumn]>,
) -> Result<Vec<Task>, OtherDefinition> {
    let mut known: Vec<Known<'_>> = Vec::new();
    for (recording, tasks) in recordings.enumerate() {
        for task in tasks.iter().map(TaskColumn::task) {
            match known.iter().find(|other| other.task.name == task.name) {
                None => known.push(Known { recording, task }),
                Some(other) if other.task.definition() == task.definition() => {}
                Some(other) => {
                    return Err(OtherDefinition {
                        recordings: [other.recording, recording],
                        problem: format!(
                            "the task `{}` in the first recording and `{}` in the second differ; evaluate them separately",
                            other.task.definition(),
                            task.definition()
                        ),
                    });
                }
            }
        }
    }
    Ok(known.into_iter().map(|own| own.task.clone()).collect())
}
