//! Scores of tasks of two tables, their merges and their comparisons.

use std::collections::BTreeMap;
use std::path::PathBuf;

use pyo3::prelude::*;
use serde::Deserialize;
use taceva_dataset::{PoseThresholds, TaskKind};
use taceva_evaluate::{
    RowKey, ScoreRequest, Shard, TaskRequest, TaskRule, TaskSpec, TaskStates, merge_task_states,
    task_states,
};
use taceva_report::{Table, TaskComparison, TaskResult, task_numbers, task_table};

use crate::errors::{study_error, value_error};
use crate::results::rendered;

/// Width of lines in the text of a comparison, in characters.
const WIDTH: usize = 100;

/// Scores of tasks, as Python receives them.
#[derive(IntoPyObject)]
pub(crate) struct TaskDocuments {
    documents: Vec<String>,
    text: String,
    html: String,
    latex: String,
    numbers: String,
    states: String,
}

/// A task as the Python side states it.
#[derive(Deserialize)]
struct AskedTask {
    /// Task in the notation of the command line; `None` if the other fields state the task.
    spec: Option<String>,
    #[serde(default)]
    name: String,
    #[serde(default)]
    kind: String,
    positive: Option<String>,
    #[serde(default)]
    names: Vec<String>,
    thresholds: Option<AskedThresholds>,
    threshold: Option<f64>,
    debounce: Option<u32>,
}

/// Thresholds between the classes of a pose, as decimal texts.
#[derive(Deserialize)]
struct AskedThresholds {
    t: Vec<String>,
    r: Vec<String>,
}

impl AskedTask {
    fn spec(&self) -> PyResult<TaskSpec> {
        if let Some(spec) = &self.spec {
            return spec.parse().map_err(value_error);
        }
        let mut spec: TaskSpec = "task=class".parse().map_err(value_error)?;
        spec.name.clone_from(&self.name);
        spec.kind = TaskKind::from_name(&self.kind).ok_or_else(|| {
            let names = TaskKind::ALL.map(TaskKind::name);
            value_error(format_args!(
                "kind {:?}: expected one of {}",
                self.kind,
                names.join(", ")
            ))
        })?;
        spec.positive.clone_from(&self.positive);
        spec.names.clone_from(&self.names);
        let thresholds = self.thresholds.as_ref();
        spec.thresholds = thresholds.map(|of| PoseThresholds::new(of.t.clone(), of.r.clone()));
        Ok(spec)
    }
}

/// Scores the tasks of a table of predictions against a table of truth. `tasks` is a JSON list, `source` the origin of the samples.
#[pyfunction]
#[pyo3(signature = (truth, prediction, tasks, cluster, key, source))]
pub(crate) fn task_scores(
    py: Python<'_>,
    truth: PathBuf,
    prediction: PathBuf,
    tasks: &str,
    cluster: Option<String>,
    key: Option<&str>,
    source: String,
) -> PyResult<TaskDocuments> {
    let asked: Vec<AskedTask> = serde_json::from_str(tasks).map_err(value_error)?;
    let mut request = TaskRequest {
        tables: ScoreRequest {
            key: key.map(RowKey::from),
            ..ScoreRequest::of_tables(truth, prediction)
        },
        tasks: Vec::new(),
        rules: BTreeMap::new(),
        cluster,
        shard: Shard::WHOLE,
    };
    for task in &asked {
        let spec = task.spec()?;
        let rule = TaskRule {
            threshold: task.threshold,
            debounce: task.debounce,
        };
        if !rule.is_empty() {
            request.rules.insert(spec.name.clone(), rule);
        }
        request.tasks.push(spec);
    }
    let states = py.detach(|| task_states(&request));
    let mut states = states.map_err(|error| study_error(&error))?;
    if states.sources.is_empty() {
        states.sources.insert(source);
    }
    documents(&states)
}

/// Merged scores of the state files at `paths`.
#[pyfunction]
pub(crate) fn merge_tasks(py: Python<'_>, paths: Vec<PathBuf>) -> PyResult<TaskDocuments> {
    let merged = py.detach(|| merge_task_states(&paths));
    documents(&merged.map_err(|error| study_error(&error))?)
}

/// Comparison of the results called `names`, whose states are at `paths`.
#[pyfunction]
pub(crate) fn compare_tasks(
    py: Python<'_>,
    names: Vec<String>,
    paths: Vec<PathBuf>,
    metrics: Vec<String>,
    seed: u64,
) -> PyResult<TaskDocuments> {
    let mut results = Vec::new();
    for (name, path) in names.into_iter().zip(&paths) {
        let states = TaskStates::read(path).map_err(|error| study_error(&error))?;
        let result = TaskResult::of(name, &states.report());
        results.push(result.map_err(value_error)?);
    }
    if let Some(unknown) = TaskComparison::unknown_metric(&results, &metrics) {
        return Err(value_error(format_args!(
            "metrics: no result has the score {unknown:?}, expected a score such as \"f1\" or \"class_accuracy\""
        )));
    }
    let comparison = py.detach(|| TaskComparison::of(&results, &metrics, seed));
    let (values, answers) = (comparison.values(), comparison.table());
    Ok(TaskDocuments {
        documents: vec![comparison.json()],
        text: format!("{}\n{}", values.text(), comparison.text(WIDTH)),
        html: rendered(&values, "html")? + &rendered(&answers, "html")?,
        latex: rendered(&answers, "tex")?,
        numbers: rendered(&answers, "csv")?,
        states: String::new(),
    })
}

/// Scores of `states` in every form, and the states themselves.
fn documents(states: &TaskStates) -> PyResult<TaskDocuments> {
    let report = states.report();
    let document = serde_json::to_string_pretty(&report).map_err(value_error)?;
    let mut file = Vec::new();
    states.write(&mut file).map_err(value_error)?;
    let table: Table = task_table(&report);
    Ok(TaskDocuments {
        documents: vec![format!("{document}\n")],
        text: rendered(&table, "text")?,
        html: rendered(&table, "html")?,
        latex: rendered(&table, "tex")?,
        numbers: rendered(&task_numbers(&report), "csv")?,
        states: String::from_utf8(file).map_err(value_error)?,
    })
}
