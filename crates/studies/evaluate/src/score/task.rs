//! Scores of tasks that another program predicted: classes, events, outcomes and changes of pose, from two tables.

mod classes;
mod depth;
mod events;
mod labels;
mod likely_scale;
mod pose;
mod rule;
mod score_columns;
mod spec;

use std::collections::{BTreeMap, BTreeSet};

use taceva_core::shown;
use taceva_dataset::TaskKind;
use taceva_import::CsvTable;
use taceva_tasks::TaskState;

use super::ScoreRequest;
use super::agreement::Matching;
use super::origins::stated_origins;
use super::row_key::{KEY_NAMES, RowKeys};
use super::shard::Shard;
use super::tables::{self, Pairing};
use crate::error::EvaluateError;
use crate::task_state_file::TaskStates;

pub use rule::TaskRule;
pub use spec::TaskSpec;

/// Default column with the clusters.
const CLUSTER: &str = "point_id";

/// Request to score the tasks of two tables.
#[derive(Clone, Debug)]
pub struct TaskRequest {
    /// Tables, key that pairs their rows, treatment of non-finite numbers, and number of threads. Channels and metrics are ignored.
    pub tables: ScoreRequest,
    /// Tasks to score, with distinct names.
    pub tasks: Vec<TaskSpec>,
    /// Rules that turn scores or classes into the scored classes, by the name of the task.
    pub rules: BTreeMap<String, TaskRule>,
    /// Column with the clusters: trajectory, clip or object; `None` for `point_id`.
    pub cluster: Option<String>,
    /// Shard of the clusters, in the order of their names, whose rows are scored.
    pub shard: Shard,
}

/// Both tables with their pairs of rows.
struct TaskTables {
    truth: CsvTable,
    prediction: CsvTable,
    pairs: Vec<RowPair>,
    /// True if rows with a non-finite number are counted and left out, false if they are rejected.
    allow_invalid: bool,
}

/// Row numbers of two paired rows.
#[derive(Clone, Copy, Debug)]
struct RowPair {
    truth: usize,
    prediction: usize,
}

/// Scores the tasks of two tables. The returned states can be written and merged, and their [`report`](TaskStates::report) contains the scores.
///
/// The column of a task has its name. The truth holds classes by name or by position. The predictions hold classes too, or a score for each
/// class in columns `NAME.p.CLASS`. A pose has seven columns: `NAME.x`, `.y`, `.z` (mm, or the unit of the
/// task in the predictions) and `.qx`, `.qy`, `.qz`, `.qw`. A place has only the first three.
///
/// For depth maps, the truth is a dataset with the task. The predictions are an array with one map for each sample, in the same order.
///
/// ```
/// use taceva_evaluate::{ScoreRequest, Shard, TaskRequest, task_states};
/// # let folder = tempfile::tempdir()?;
/// # let [truth, prediction] = ["truth.csv", "prediction.csv"].map(|name| folder.path().join(name));
/// std::fs::write(&truth, "id,clip,grasp\n1,a,held\n2,a,lost\n3,b,held\n")?;
/// std::fs::write(&prediction, "id,grasp\n3,held\n1,held\n2,held\n")?;
/// let report = task_states(&TaskRequest {
///     tables: ScoreRequest::of_tables(truth, prediction),
///     tasks: vec!["grasp=outcome:positive=held".parse()?],
///     rules: Default::default(),
///     cluster: Some("clip".to_owned()),
///     shard: Shard::WHOLE,
/// })?
/// .report();
/// let accuracy = &report.tasks[0].scores[0];
/// assert_eq!((accuracy.metric, accuracy.estimate.value), ("class_accuracy", Ok(2.0 / 3.0)));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`EvaluateError`] if a table cannot be read, rows do not pair, a column is missing, or a cell is not a class, number or rotation.
pub fn task_states(request: &TaskRequest) -> Result<TaskStates, EvaluateError> {
    check_names(request)?;
    if let Some(task) = request.tasks.iter().find(|of| of.kind == TaskKind::Depth) {
        return depth::states(request, task);
    }
    tables::check_distinct(&request.tables)?;
    let [(truth, of_truth), (prediction, of_prediction)] = tables::read_both(&request.tables)?;
    tables::check_rows(&truth)?;
    tables::check_rows(&prediction)?;
    let keys = RowKeys::of(&truth, &prediction, request.tables.key.as_ref(), |name| {
        request.tasks.iter().any(|task| task.name == name)
    })?;
    let (pairing, key) = tables::pair(&truth, &prediction, &keys)?;
    let matching = Matching::of([&truth, &prediction], &keys, key)?;
    let pairs = pairs(&pairing, truth.rows());
    let numbers = pairs.iter().map(|pair| (pair.truth, pair.prediction));
    matching.check([&truth, &prediction], numbers)?;
    let digests = [("truth", of_truth), ("prediction", of_prediction)];
    let digests = digests.map(|(role, digest)| (role.to_owned(), digest.to_string()));
    let mut states = TaskStates::new(matching.by.to_string(), digests.into());
    states
        .sources
        .extend(stated_origins(&truth)?.unwrap_or_default());
    let tables = TaskTables {
        truth,
        prediction,
        pairs,
        allow_invalid: request.tables.allow_invalid,
    };
    let clusters = Clusters::of(&tables, request.cluster.as_deref())?;
    let clusters = clusters.in_shard(request.shard, &tables.pairs);
    for task in &request.tasks {
        let rule = request.rules.get(&task.name);
        states.tasks.push(match task.kind {
            TaskKind::Pose | TaskKind::Place => pose::state(&tables, &clusters, task)?,
            _ => classes::state(&tables, &clusters, task, rule)?,
        });
    }
    Ok(match request.shard {
        Shard::WHOLE => states,
        shard => states.of_shard(shard.number(), shard.of()),
    })
}

/// Refuses a request without a task, a task that is named twice, and a rule of an unknown task.
fn check_names(request: &TaskRequest) -> Result<(), EvaluateError> {
    let names = || request.tasks.iter().map(|task| task.name.as_str());
    if request.tasks.is_empty() {
        return Err(EvaluateError::Request("no task to score".to_owned()));
    }
    let mut before = Vec::new();
    for name in names() {
        if before.contains(&name) {
            return Err(EvaluateError::Request(format!(
                "the task `{}` is given twice",
                shown(name)
            )));
        }
        before.push(name);
    }
    let mut measured = request.tasks.iter().filter(|of| !of.kind.has_classes());
    if let Some(of) = measured.find(|of| request.rules.contains_key(&of.name)) {
        return Err(EvaluateError::Request(format!(
            "a threshold or a debounce is given for `{}`, which is a {}: omit this option",
            shown(&of.name),
            of.kind.name()
        )));
    }
    match request
        .rules
        .keys()
        .find(|of| !names().any(|name| name == *of))
    {
        Some(unknown) => Err(EvaluateError::Request(format!(
            "a rule is given for `{}`, expected one of the tasks {}",
            shown(unknown),
            before.join(", ")
        ))),
        None => Ok(()),
    }
}

fn pairs(pairing: &Pairing, rows: usize) -> Vec<RowPair> {
    let pair = |(truth, prediction)| RowPair { truth, prediction };
    match pairing {
        Pairing::ByOrder => (0..rows).zip(0..rows).map(pair).collect(),
        Pairing::ByKey(paired) => (0..).zip(paired.iter().copied()).map(pair).collect(),
    }
}

/// Column with the clusters of the rows.
struct Clusters<'a> {
    table: &'a CsvTable,
    is_truth: bool,
    column: usize,
    /// Clusters of the shard; `None` for all.
    own: Option<BTreeSet<&'a str>>,
}

impl<'a> Clusters<'a> {
    /// Clusters in the column `named`, by default `point_id`. If the truth lacks this column, the predictions must have it.
    fn of(tables: &'a TaskTables, named: Option<&str>) -> Result<Clusters<'a>, EvaluateError> {
        let name = named.unwrap_or(CLUSTER);
        let is_truth = tables.truth.has(name) || !tables.prediction.has(name);
        let table = match is_truth {
            true => &tables.truth,
            false => &tables.prediction,
        };
        if named.is_none() && !table.has(name) {
            let beside = table.names().iter().map(String::as_str);
            let beside = beside.filter(|name| !KEY_NAMES.contains(name) && !name.is_empty());
            return Err(EvaluateError::Tables {
                path: table.path().to_owned(),
                problem: format!(
                    "no column `{CLUSTER}`: frames of one trajectory, clip or object resemble each other, so name the column that tells them \
                     apart with --cluster COLUMN; the columns are {}",
                    listed(beside)
                ),
            });
        }
        Ok(Clusters {
            table,
            is_truth,
            column: table.position(name)?,
            own: None,
        })
    }

    /// The clusters of `shard` alone. All rows of a cluster are in one shard, so that sequences stay whole.
    fn in_shard(self, shard: Shard, pairs: &[RowPair]) -> Clusters<'a> {
        if shard.is_whole() {
            return self;
        }
        let all: BTreeSet<&str> = pairs.iter().map(|pair| self.text(*pair)).collect();
        let places = shard.rows(all.len() as u64);
        let own = (0_u64..)
            .zip(all)
            .filter(|(place, _)| places.contains(place));
        Clusters {
            own: Some(own.map(|(_, cluster)| cluster).collect()),
            ..self
        }
    }

    /// True if the rows of `pair` are scored.
    fn has(&self, pair: RowPair) -> bool {
        let own = self.own.as_ref();
        own.is_none_or(|own| own.contains(self.text(pair)))
    }

    /// Cell of the cluster column for `pair`; empty for rows without a cluster.
    fn text(&self, pair: RowPair) -> &'a str {
        self.table.cell(self.row(pair), self.column)
    }

    /// Row number of `pair` in the table that has the cluster column.
    fn row(&self, pair: RowPair) -> usize {
        match self.is_truth {
            true => pair.truth,
            false => pair.prediction,
        }
    }

    /// Name of the cluster column.
    fn name(&self) -> &'a str {
        &self.table.names()[self.column]
    }

    /// Cluster of a pair of rows.
    fn cell(&self, pair: RowPair) -> Result<&'a str, EvaluateError> {
        match self.text(pair) {
            "" => {
                let expected = "expected the cluster of the row";
                let row = self.row(pair);
                Err(self.table.refuse(row, self.column, expected).into())
            }
            cluster => Ok(cluster),
        }
    }
}

/// True for a number that is NaN or infinite.
fn is_not_finite(cell: &str) -> bool {
    let number = cell.trim().parse::<f64>();
    number.is_ok_and(|number| !number.is_finite())
}

/// Names for a message, separated by commas.
fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    let names: Vec<String> = names.map(|name| shown(name).to_string()).collect();
    names.join(", ")
}

/// Sums for the scores of `task`, before any sample.
fn empty(task: &TaskSpec, clusters: &Clusters<'_>) -> TaskState {
    TaskState::new(task.name.as_str(), task.kind.name(), clusters.name())
}
