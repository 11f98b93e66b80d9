//! Tasks of a sweep with their results, and groups of tasks that differ only in their seed.

use std::collections::BTreeMap;

use crate::error::SweepError;
use crate::failure::Failure;
use crate::folder::SweepFolder;
use crate::result::TaskResult;
use crate::task::Task;
use crate::task_list::TaskList;

/// A task with its result.
#[derive(Clone, Debug)]
pub(crate) struct Loaded<'a> {
    pub(crate) task: &'a Task,
    pub(crate) found: Found,
}

/// State of a task: its result, the reason for its failure, or neither.
#[derive(Clone, Debug)]
pub(crate) enum Found {
    Result(Box<TaskResult>),
    Failed(String),
    Missing,
}

impl Loaded<'_> {
    pub(crate) fn result(&self) -> Option<&TaskResult> {
        match &self.found {
            Found::Result(result) => Some(result),
            Found::Failed(_) | Found::Missing => None,
        }
    }
}

/// Reads the result or failure of every task of `list`.
pub(crate) fn load<'a>(
    folder: &SweepFolder,
    list: &'a TaskList,
) -> Result<Vec<Loaded<'a>>, SweepError> {
    let load = |task: &'a Task| {
        let found = match TaskResult::read(folder, &task.key)? {
            Some(result) => Found::Result(Box::new(result)),
            None => Failure::read(folder, &task.key)?
                .map_or(Found::Missing, |failure| Found::Failed(failure.reason)),
        };
        Ok(Loaded { task, found })
    };
    list.tasks.iter().map(load).collect()
}

/// Tasks that differ only in their seed.
#[derive(Clone, Debug)]
pub(crate) struct Group<'a> {
    pub(crate) dataset: &'a str,
    pub(crate) split: Option<&'a str>,
    pub(crate) configuration: String,
    /// Results in the order of the tasks, each with the seed of its task.
    pub(crate) results: Vec<(u64, &'a TaskResult)>,
    /// True if there is a result for every seed.
    pub(crate) is_whole: bool,
}

impl Group<'_> {
    /// Mean over seeds of the validation error of `channel`, with its unit; `None` if a result lacks this error.
    pub(crate) fn validation(&self, channel: &str) -> Option<(f64, &str)> {
        let mut sum = 0.0;
        let mut unit = None;
        for (_, result) in &self.results {
            let mut errors = result.validation.iter();
            let error = errors.find(|error| error.channel == channel)?;
            sum += error.rmse;
            unit = Some(error.unit.symbol());
        }
        Some((sum / self.results.len() as f64, unit?))
    }

    /// Scores of `metric` on `channel`, one for each seed with a score.
    pub(crate) fn values(&self, metric: &str, channel: &str) -> Vec<f64> {
        let results = self.results.iter();
        let scores =
            results.filter_map(|(_, result)| result.score(metric, channel)?.value.number());
        scores.collect()
    }

    /// Names of the recording and the split of the group; `None` for the default split.
    pub(crate) fn place(&self) -> (&str, Option<&str>) {
        (self.dataset, self.split)
    }
}

/// Groups the tasks by recording, split and configuration, in the order of the table.
pub(crate) fn groups<'a>(loaded: &'a [Loaded<'a>]) -> Vec<Group<'a>> {
    let mut positions: BTreeMap<(&str, Option<&str>, String), usize> = BTreeMap::new();
    let mut groups: Vec<Group<'a>> = Vec::new();
    for one in loaded {
        let task = one.task;
        let configuration = task.configuration();
        let key = (
            task.dataset.as_str(),
            task.split.as_deref(),
            configuration.clone(),
        );
        let at = *positions.entry(key).or_insert_with(|| {
            groups.push(Group {
                dataset: &task.dataset,
                split: task.split.as_deref(),
                configuration,
                results: Vec::new(),
                is_whole: true,
            });
            groups.len() - 1
        });
        match one.result() {
            Some(result) => groups[at].results.push((task.seed, result)),
            None => groups[at].is_whole = false,
        }
    }
    groups
}

/// Channels with known errors, in the order of the first result.
pub(crate) fn channels(loaded: &[Loaded<'_>]) -> Vec<String> {
    let results = loaded.iter().filter_map(Loaded::result);
    let scores = results.flat_map(|result| &result.scores);
    let errors = scores.filter(|score| score.metric == "mae");
    taceva_core::distinct(errors.map(|score| score.channel.clone()))
}
