//! States of tasks as files. Laboratories can exchange and merge such files, and the scores equal those of one run over all tables.

use std::collections::{BTreeMap, BTreeSet};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::{Deserialize, Serialize};
use taceva_core::shown;
use taceva_files::seal::Edit;
use taceva_tasks::{TaskReport, TaskState};

use crate::error::EvaluateError;
use crate::state_file::{Head, read_capped};

/// Schema of a file with states of tasks.
pub const TASK_STATE_SCHEMA: &str = "taceva.tasks-state/1.0";

/// Roles of the tables whose rows may be counted only once.
const COUNTED_ONCE: [&str; 2] = ["truth", "dataset"];

/// States of the tasks of one or several pairs of tables, with everything behind their report.
///
/// ```
/// use taceva_evaluate::{TASK_STATE_SCHEMA, TaskStates};
/// let states = TaskStates::new("by `id`".to_owned(), Default::default());
/// let mut file = Vec::new();
/// states.write(&mut file)?;
/// assert!(String::from_utf8(file)?.contains(TASK_STATE_SCHEMA));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
#[non_exhaustive]
pub struct TaskStates {
    schema: String,
    /// Digests of the tables of each merged pair, by their role: `truth`, `prediction`, or `dataset`.
    tables: BTreeSet<BTreeMap<String, String>>,
    /// Origins of the samples, such as `recorded` and `simulated`.
    pub sources: BTreeSet<String>,
    /// Description of the pairing of rows, for each merged pair of tables.
    paired: BTreeSet<String>,
    /// Shards whose rows are counted; `None` if all rows of the tables are counted.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    shards: Option<Shards>,
    /// State of each task, in the requested order.
    pub tasks: Vec<TaskState>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    history: Vec<Edit>,
    #[serde(default, skip_serializing)]
    seal: Option<serde_json::Value>,
}

/// Some of the shards of two tables.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Shards {
    /// Numbers of the shards, from 1.
    numbers: BTreeSet<u32>,
    /// Number of all shards.
    of: u32,
}

impl TaskStates {
    /// State without tasks. `paired` describes the pairing of rows, and `tables` has the digests of the tables by their role.
    pub fn new(paired: String, tables: BTreeMap<String, String>) -> TaskStates {
        TaskStates {
            schema: TASK_STATE_SCHEMA.to_owned(),
            tables: [tables].into(),
            sources: BTreeSet::new(),
            paired: [paired].into(),
            shards: None,
            tasks: Vec::new(),
            history: Vec::new(),
            seal: None,
        }
    }

    /// The same states as shard `number` of `of` shards.
    pub(crate) fn of_shard(self, number: u32, of: u32) -> TaskStates {
        TaskStates {
            shards: Some(Shards {
                numbers: [number].into(),
                of,
            }),
            ..self
        }
    }

    /// True unless shards of the tables are missing.
    pub fn is_whole(&self) -> bool {
        self.shards.is_none()
    }

    /// Digests of the tables of each merged pair, by their role.
    pub fn tables(&self) -> impl Iterator<Item = &BTreeMap<String, String>> {
        self.tables.iter()
    }

    /// Scores of all tasks.
    pub fn report(&self) -> TaskReport {
        let paired: Vec<&str> = self.paired.iter().map(String::as_str).collect();
        let mut report = TaskReport::new(env!("CARGO_PKG_VERSION"), paired.join("; "));
        let is_one = self.tables.len() == 1;
        for (number, tables) in (1..).zip(&self.tables) {
            let named = tables.iter().map(|(role, digest)| match is_one {
                true => (role.clone(), digest.clone()),
                false => (format!("{role} {number}"), digest.clone()),
            });
            report.tables.extend(named);
        }
        report.sources = self.sources.iter().cloned().collect();
        report.tasks = self.tasks.iter().map(TaskState::scores).collect();
        if let Some(shards) = &self.shards {
            let numbers: Vec<String> = shards.numbers.iter().map(u32::to_string).collect();
            for task in &mut report.tasks {
                task.notes.push(format!(
                    "only rows of shard {} of {}: merge the states of all shards for the scores of the tables",
                    numbers.join(", "),
                    shards.of
                ));
            }
        }
        report
    }

    /// Adds all samples of `other`, or returns the reason why the states do not merge.
    ///
    /// # Errors
    /// The reason: other tasks, another definition of a task, or rows that would count twice.
    pub fn merge(mut self, mut other: TaskStates) -> Result<TaskStates, String> {
        let named = |states: &TaskStates| -> Vec<String> {
            states.tasks.iter().map(|task| task.name.clone()).collect()
        };
        if named(&self) != named(&other) {
            // Sorted by name, so that the order of merges has no effect.
            for tasks in [&mut self.tasks, &mut other.tasks] {
                tasks.sort_by(|one, another| one.name.cmp(&another.name));
            }
        }
        let [ours, theirs] = [named(&self), named(&other)];
        if ours != theirs {
            return Err(format!(
                "the tasks are {}, but {} in the other state; score both with the same --task",
                shown(&theirs.join(", ")),
                shown(&ours.join(", "))
            ));
        }
        let is_sharded = self.shards.is_some() || other.shards.is_some();
        if is_sharded {
            self.shards = self.joined_shards(&other)?;
        } else if let Some(digest) = self.counted_twice(&other) {
            return Err(format!(
                "the labels ({}) are also in another state, so each row would count twice; name each state once",
                shown(&digest)
            ));
        }
        let tasks = self.tasks.drain(..).zip(other.tasks);
        let merged = tasks.map(|(ours, theirs)| {
            let name = ours.name.clone();
            let merged = ours.merge(theirs);
            merged.map_err(|error| format!("task `{}`: {error}", shown(&name)))
        });
        let merged: Vec<TaskState> = merged.collect::<Result<_, String>>()?;
        self.tasks = merged;
        self.tables.extend(other.tables);
        self.sources.extend(other.sources);
        self.paired.extend(other.paired);
        Ok(self)
    }

    /// Shards of both states; `None` if no shard is missing.
    fn joined_shards(&self, other: &TaskStates) -> Result<Option<Shards>, String> {
        let (Some(ours), Some(theirs)) = (&self.shards, &other.shards) else {
            return Err(
                "one of the states is a shard and another has whole tables; merge all shards of one table first, with --state-out".to_owned(),
            );
        };
        if self.tables != other.tables || ours.of != theirs.of {
            return Err(format!(
                "the states have {} and {} shards, or shards of other tables; merge shards of the same two tables, with the same number of shards",
                theirs.of, ours.of
            ));
        }
        if let Some(number) = ours.numbers.intersection(&theirs.numbers).next() {
            return Err(format!(
                "shard {number} of {} is also in another state, so each row would count twice; name each state once",
                ours.of
            ));
        }
        let numbers: BTreeSet<u32> = ours.numbers.union(&theirs.numbers).copied().collect();
        let is_whole = numbers.len() as u64 == u64::from(ours.of);
        Ok((!is_whole).then_some(Shards {
            numbers,
            of: ours.of,
        }))
    }

    /// Digest of labels that both states contain; `None` without such labels.
    fn counted_twice(&self, other: &TaskStates) -> Option<String> {
        let labels = |states: &TaskStates| -> BTreeSet<String> {
            let tables = states.tables.iter();
            let of_part = |tables: &BTreeMap<String, String>| {
                COUNTED_ONCE.map(|role| tables.get(role).cloned())
            };
            tables.flat_map(of_part).flatten().collect()
        };
        labels(self).intersection(&labels(other)).next().cloned()
    }

    /// True if the file at `path` has a schema of states of tasks.
    pub fn is_at(path: &Path) -> bool {
        let head = read_capped(path)
            .ok()
            .and_then(|text| serde_json::from_str::<Head>(&text).ok());
        head.is_some_and(|head| head.schema == TASK_STATE_SCHEMA)
    }

    /// Reads the file at `path`.
    ///
    /// # Errors
    /// [`EvaluateError::State`] for a file that has no states of tasks, or was edited after it was sealed.
    pub fn read(path: &Path) -> Result<TaskStates, EvaluateError> {
        let wrong = |problem: String| EvaluateError::State {
            path: path.to_owned(),
            problem,
        };
        let text = read_capped(path).map_err(|error| wrong(error.to_string()))?;
        let head: Head = serde_json::from_str(&text)
            .map_err(|error| wrong(format!("not a file of states: {error}")))?;
        if head.schema != TASK_STATE_SCHEMA {
            return Err(wrong(format!(
                "its schema is `{}`, expected `{TASK_STATE_SCHEMA}`, as `score --task` and `evaluate --task` write it with --state-out",
                shown(&head.schema)
            )));
        }
        taceva_files::seal::json::check(&text).map_err(|error| wrong(error.to_string()))?;
        let mut states: TaskStates =
            serde_json::from_str(&text).map_err(|error| wrong(error.to_string()))?;
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        for edit in std::mem::take(&mut states.history) {
            for task in &mut states.tasks {
                task.notes.push(format!("state {name}, {edit}"));
            }
        }
        states.seal = None;
        Ok(states)
    }

    /// Writes the states as sealed JSON in one line.
    ///
    /// # Errors
    /// Errors of `out`.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let text = serde_json::to_string(self)?;
        let sealed = taceva_files::seal::json::seal(&text).map_err(io::Error::other)?;
        writeln!(out, "{sealed}")
    }
}

/// Merges files with states of tasks.
///
/// # Errors
/// [`EvaluateError::State`] with the first file that cannot be merged with the earlier files. [`EvaluateError::Request`] without a file.
pub fn merge_task_states(paths: &[PathBuf]) -> Result<TaskStates, EvaluateError> {
    let mut merged: Option<TaskStates> = None;
    for path in paths {
        let states = TaskStates::read(path)?;
        merged = Some(match merged {
            None => states,
            Some(before) => before
                .merge(states)
                .map_err(|problem| EvaluateError::State {
                    path: path.clone(),
                    problem,
                })?,
        });
    }
    merged.ok_or_else(|| {
        EvaluateError::Request("no state file is given, expected one or more".to_owned())
    })
}
