//! Compares true depth maps of a dataset with predicted depth maps of an array.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::Path;

use taceva_core::{SourceUnit, counted, shown};
use taceva_dataset::{Dataset, DatasetError, Digest, Task, TaskKind};
use taceva_import::MapsFile;
use taceva_models::Part;
use taceva_tasks::TaskState;
use taceva_tasks::depth::{DepthMap, DepthTask};

use super::{TaskRequest, TaskSpec};
use crate::depth_pairs::{DepthPairs, definition, of_sample};
use crate::error::EvaluateError;
use crate::mean_map::{mean_map, rows_of};
use crate::subject;
use crate::task_state_file::TaskStates;

/// Sums for the scores of the depth maps of the task `of`, whose truth is a dataset.
pub(super) fn states(request: &TaskRequest, of: &TaskSpec) -> Result<TaskStates, EvaluateError> {
    if request.tasks.len() > 1 {
        return Err(EvaluateError::Request(format!(
            "`{}` has depth maps, whose truth is a dataset: score this task alone",
            shown(&of.name)
        )));
    }
    if !request.shard.is_whole() {
        return Err(EvaluateError::Request(format!(
            "`{}` has depth maps, which are scored whole: omit the shard",
            shown(&of.name)
        )));
    }
    if request.tables.key.is_some() {
        return Err(EvaluateError::Request(format!(
            "a key is given for the depth maps `{}`, which are paired in the order of the samples of the dataset: omit the key",
            shown(&of.name)
        )));
    }
    let (truth, prediction) = (&request.tables.truth, &request.tables.prediction);
    if !truth.is_dir() {
        return Err(EvaluateError::Tables {
            path: truth.clone(),
            problem: format!(
                "no dataset: the truth of the depth maps `{}` is a dataset with [task.{}], made by `taceva import`",
                shown(&of.name),
                shown(&of.name)
            ),
        });
    }
    let dataset = Dataset::open(truth)?;
    let task = task_of(&dataset, of, request.cluster.as_deref())?;
    let unit = of.length_unit()?;
    let maps = MapsFile::open(prediction, None)?;
    let rows = dataset.table().rows();
    if maps.count() != rows as u64 {
        return Err(EvaluateError::Tables {
            path: prediction.clone(),
            problem: format!(
                "{} depth maps for {}: expected one for each sample of {}, in their order",
                maps.count(),
                counted(rows, "sample"),
                shown(truth)
            ),
        });
    }
    let mut tables = BTreeMap::from([("truth".to_owned(), dataset.digest().to_string())]);
    // A zarr is a folder, which has no digest of its own.
    if prediction.is_file() {
        tables.insert("prediction".to_owned(), digest_of(prediction)?.to_string());
    }
    let paired = "in the order of the samples of the dataset".to_owned();
    let mut states = TaskStates::new(paired, tables);
    states.sources.insert(subject::of(&dataset).source);
    let scored = Scored {
        dataset: &dataset,
        task: &task,
        maps: &maps,
        unit,
    };
    states.tasks.push(scored.state(depth_task(of, &task)?)?);
    Ok(states)
}

/// True depth maps of a dataset, and predicted depth maps of a file.
struct Scored<'a> {
    dataset: &'a Dataset,
    task: &'a Task,
    maps: &'a MapsFile,
    /// Unit of the predicted depths.
    unit: SourceUnit,
}

impl Scored<'_> {
    fn state(&self, definition: DepthTask) -> Result<TaskState, EvaluateError> {
        let task = self.task;
        let (dataset, name) = (self.dataset, task.name.as_str());
        let training = rows_of(dataset.table(), Part::Train);
        let scored: Vec<usize> = match training.is_empty() {
            true => (0..dataset.table().rows()).collect(),
            false => rows_of(dataset.table(), Part::Test),
        };
        let mean = mean_map(dataset, name, &training)?;
        let has_mean = mean.is_some();
        let definition = match mean {
            Some(mean) => definition.with_constant(mean),
            None => definition,
        };
        let mut pairs = DepthPairs::new(dataset, task, definition);
        let [rows, columns] = self.maps.size();
        for row in scored {
            pairs.push(row, || {
                let numbers = self.maps.map(row as u64)?.into_iter();
                let depths = numbers.map(|depth| self.unit.convert(depth)).collect();
                DepthMap::new(rows, columns, depths)
                    .map_err(|error| of_sample(dataset, task, row, &error))
            })?;
        }
        let mut of_task = pairs.into_state(match training.is_empty() {
            true => "",
            false => " of the declared test part",
        })?;
        if !training.is_empty() {
            let samples = counted(training.len(), "sample");
            let constant = match has_mean {
                true => format!("the constant is the mean map of {samples} of the training part"),
                false => {
                    format!("no constant, because no map is in the {samples} of the training part")
                }
            };
            of_task
                .notes
                .push(format!("only the declared test part is scored; {constant}"));
        }
        Ok(of_task)
    }
}

/// The task of the dataset, with the clusters of the column `cluster` if this column is given.
fn task_of(dataset: &Dataset, of: &TaskSpec, cluster: Option<&str>) -> Result<Task, EvaluateError> {
    let own = dataset.tasks().iter().map(|own| own.task());
    let found = own.clone().find(|task| task.name == of.name);
    let Some(task) = found.filter(|task| task.kind == TaskKind::Depth) else {
        let maps = own.filter(|task| task.kind == TaskKind::Depth);
        let maps: Vec<&str> = maps.map(|task| task.name.as_str()).collect();
        return Err(EvaluateError::Request(format!(
            "{} has no depth maps `{}`, expected one of its tasks of kind depth: {}",
            shown(dataset.path()),
            shown(&of.name),
            match maps.as_slice() {
                [] => "none".to_owned(),
                maps => maps.join(", "),
            }
        )));
    };
    let mut task = task.clone();
    if let Some(cluster) = cluster {
        if dataset.table().as_text(cluster).is_none() {
            return Err(EvaluateError::Request(format!(
                "--cluster `{}`: {} has no such id or attribute",
                shown(cluster),
                shown(dataset.path())
            )));
        }
        cluster.clone_into(&mut task.cluster);
    }
    Ok(task)
}

/// Definition of the task, with the contact depth `gate` of `of` and the pixel size of the dataset.
fn depth_task(of: &TaskSpec, task: &Task) -> Result<DepthTask, EvaluateError> {
    let refused =
        |problem: String| EvaluateError::Request(format!("task `{}`: {problem}", shown(&of.name)));
    let own = definition(task)?;
    let Some(gate) = &of.gate else {
        return Ok(own);
    };
    let gate_mm: f64 = gate
        .parse()
        .map_err(|_| refused(format!("`gate={}`: expected a number in mm", shown(gate))))?;
    own.with_gate_mm(gate_mm)
        .map_err(|error| refused(error.to_string()))
}

fn digest_of(path: &Path) -> Result<Digest, EvaluateError> {
    let digest = File::open(path).and_then(|mut file| Digest::of_reader(&mut file));
    Ok(digest.map_err(DatasetError::io("read", path))?)
}
