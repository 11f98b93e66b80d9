//! Tasks in a map: labels other than measured quantities, and their definitions.

mod maps;
mod names;
mod place;

use std::collections::BTreeMap;

use serde::Deserialize;
use taceva_core::{SourceUnit, Unit, nearest};
use toml::Spanned;

use super::check::{Check, ColumnName};
use super::{ClassMap, IdMap};
use maps::{Invalid, MapArray, WrittenArray};
use names::{problem_of_limits, problem_of_names};
use taceva_dataset::internal::{is_attribute_name, listed, shown};
use taceva_dataset::{DatasetError, PoseThresholds, Task, TaskKind};

pub(crate) use names::no_name;

/// Column with the imported table of each row, which exists without a map entry.
const SOURCE_TABLE: &str = "source_table";

/// Task with its source.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct TaskMap {
    /// Definition of the task. The task has 1 source column for classes and depth-map files, 3 for places, 7 for poses, and 12 for poses with a
    /// rotation matrix.
    pub(crate) task: Task,
    /// Units of the positions x, y, z of a pose or a place; empty for other tasks.
    pub(crate) units: Vec<SourceUnit>,
    /// Array with the depth maps of all rows; `None` if a column names a file for each row, and for other tasks.
    pub(crate) array: Option<MapArray>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table")]
pub(super) struct WrittenTask {
    kind: Spanned<String>,
    from: Option<WrittenFrom>,
    names: Option<Spanned<Vec<String>>>,
    positive: Option<Spanned<String>>,
    cluster: Option<Spanned<String>>,
    #[serde(default)]
    time: bool,
    rule: Option<String>,
    unit: Option<Spanned<WrittenUnits>>,
    over: Option<u32>,
    frame: Option<String>,
    thresholds: Option<Spanned<WrittenThresholds>>,
    array: Option<Spanned<WrittenArray>>,
    scale: Option<Spanned<f64>>,
    pixel_mm: Option<Spanned<[f64; 2]>>,
    invalid: Option<Spanned<Invalid>>,
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "the name of a column, or { t = [three columns] }, with q = [four columns] or m = [nine columns] for a pose"
)]
enum WrittenFrom {
    Column(ColumnName),
    Pose(WrittenPose),
    Matrix(WrittenMatrix),
    Place(WrittenPlace),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenMatrix {
    t: [ColumnName; 3],
    m: [ColumnName; 9],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenPlace {
    t: [ColumnName; 3],
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct WrittenPose {
    t: [ColumnName; 3],
    q: [ColumnName; 4],
}

#[derive(Deserialize)]
#[serde(
    untagged,
    expecting = "a unit of length, or a list with one for each of x, y and z"
)]
enum WrittenUnits {
    One(String),
    Several(Vec<String>),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields, expecting = "{ t = [decimals], r = [decimals] }")]
struct WrittenThresholds {
    #[serde(default)]
    t: Vec<String>,
    #[serde(default)]
    r: Vec<String>,
}

/// Parts of a map that the checks of its tasks need.
pub(super) struct TaskContext {
    /// Ids and attributes that can be the cluster of a task.
    clusters: Vec<String>,
    has_time: bool,
}

impl TaskContext {
    /// Context of a map with these `ids` and `attributes`; `has_time` is true if the map names a time column.
    pub(super) fn new<'n>(
        ids: &IdMap,
        attributes: impl Iterator<Item = &'n String>,
        has_time: bool,
    ) -> TaskContext {
        let own = [
            ("point_id", !ids.point_id.is_empty()),
            ("sample", ids.sample.is_some()),
            ("unit_id", ids.unit_id.is_some()),
            ("scene", ids.scene.is_some()),
            ("repeat", ids.repeat.is_some()),
            ("part", ids.part.is_some()),
            (SOURCE_TABLE, true),
        ];
        let own = own.into_iter().filter(|(_, is_mapped)| *is_mapped);
        let own = own.map(|(name, _)| name.to_owned());
        TaskContext {
            clusters: own.chain(attributes.cloned()).collect(),
            has_time,
        }
    }
}

impl Check<'_> {
    pub(super) fn tasks(
        &self,
        written: BTreeMap<String, Spanned<WrittenTask>>,
        context: &TaskContext,
    ) -> Result<Vec<TaskMap>, DatasetError> {
        let tasks = written.into_iter().map(|(name, task)| {
            let offset = task.span().start;
            self.task(&name, task.into_inner(), offset, context)
        });
        tasks.collect()
    }

    fn task(
        &self,
        name: &str,
        written: WrittenTask,
        offset: usize,
        context: &TaskContext,
    ) -> Result<TaskMap, DatasetError> {
        if !is_attribute_name(name) {
            let problem = format!(
                "the name `{}` of a task is reserved or invalid: expected a letter, then letters, digits or `_`",
                shown(name)
            );
            return Err(self.at(offset, &problem));
        }
        if written.time && !context.has_time {
            let problem = format!(
                "[task.{name}] has `time = true`, but [time] has no `column`: name the column of the times, or remove `time`"
            );
            return Err(self.at(offset, &problem));
        }
        let kind = self.task_kind(&written.kind)?;
        let cluster = self.cluster(name, written.cluster.as_ref(), offset, context)?;
        let mut task = Task::new(name, kind, cluster);
        task.is_timed = written.time;
        task.rule.clone_from(&written.rule);
        if kind != TaskKind::Depth && written.is_of_maps() {
            let problem =
                "`array`, `scale`, `pixel_mm` and `invalid` apply to `kind = \"depth\"` only";
            return Err(self.at(offset, problem));
        }
        if kind != TaskKind::Depth && written.from.is_none() {
            let problem = format!("[task.{name}] needs `from`, the column of its labels");
            return Err(self.at(offset, &problem));
        }
        match kind {
            TaskKind::Pose => self.pose(task, written, offset),
            TaskKind::Place => self.place(task, written, offset),
            TaskKind::Depth => self.maps_of(task, written, offset),
            _ => self.classes_of(task, written, offset),
        }
    }

    fn task_kind(&self, written: &Spanned<String>) -> Result<TaskKind, DatasetError> {
        let word = written.get_ref().as_str();
        if let Some(kind) = TaskKind::from_name(word) {
            return Ok(kind);
        }
        let known = TaskKind::ALL.map(TaskKind::name);
        let problem = match nearest(word, known) {
            Some(guess) => format!("is not a kind of task, did you mean `{guess}`"),
            None => "is not a kind of task".to_owned(),
        };
        let problem = format!("`{}` {problem}: expected {}", shown(word), known.join(", "));
        Err(self.at(written.span().start, &problem))
    }

    /// Cluster of a task: the stated id or attribute, otherwise the contact point.
    fn cluster(
        &self,
        name: &str,
        written: Option<&Spanned<String>>,
        offset: usize,
        context: &TaskContext,
    ) -> Result<String, DatasetError> {
        let known = &context.clusters;
        let (cluster, offset) = match written {
            Some(written) => (written.get_ref().as_str(), written.span().start),
            None => ("point_id", offset),
        };
        if known.iter().any(|known| known == cluster) {
            return Ok(cluster.to_owned());
        }
        let problem = match written {
            None => format!(
                "[task.{name}] needs `cluster`, the id or attribute that similar samples share, such as the trajectory, clip or object: state \
                 `cluster`, one of {}",
                listed(known)
            ),
            Some(_) => {
                let guess = nearest(cluster, known.iter().map(String::as_str));
                let guess = guess.map_or_else(String::new, |guess| {
                    format!(", did you mean `{}`", shown(guess))
                });
                format!(
                    "`{}` is not an id or attribute of this map{guess}: `cluster` is one of {}",
                    shown(cluster),
                    listed(known)
                )
            }
        };
        Err(self.at(offset, &problem))
    }

    fn classes_of(
        &self,
        mut task: Task,
        written: WrittenTask,
        offset: usize,
    ) -> Result<TaskMap, DatasetError> {
        let is_pose = written.unit.is_some()
            || written.over.is_some()
            || written.frame.is_some()
            || written.thresholds.is_some();
        let from = match written.from {
            Some(WrittenFrom::Column(column)) if !is_pose => column.into_name(),
            _ => {
                let problem = "`from` with `t` and `q`, `unit`, `over`, `frame` and `thresholds` apply to `kind = \"pose\"` only";
                return Err(self.at(offset, problem));
            }
        };
        let names = written.names.ok_or_else(|| {
            let problem = format!(
                "[task.{}] needs `names`, all classes in the order of their positions",
                task.name
            );
            self.at(offset, &problem)
        })?;
        let at_names = names.span().start;
        let class = ClassMap {
            from,
            names: names.into_inner(),
        };
        if let Some(problem) = problem_of_names(&class, task.kind) {
            return Err(self.at(at_names, &problem));
        }
        if let Some(positive) = &written.positive
            && !class.names.contains(positive.get_ref())
        {
            let problem = format!(
                "`positive` is `{}`, {}",
                shown(positive.get_ref()),
                no_name(positive.get_ref(), &class.names)
            );
            return Err(self.at(positive.span().start, &problem));
        }
        if written.positive.is_none() && task.kind == TaskKind::Event {
            let problem = format!(
                "[task.{}] needs `positive`, the name that begins an event",
                task.name
            );
            return Err(self.at(offset, &problem));
        }
        let second = class
            .names
            .get(1)
            .filter(|_| task.kind == TaskKind::Outcome);
        task.positive = written
            .positive
            .map(Spanned::into_inner)
            .or_else(|| second.cloned());
        task.from = vec![class.from];
        task.names = class.names;
        Ok(TaskMap {
            task,
            units: Vec::new(),
            array: None,
        })
    }

    fn pose(
        &self,
        mut task: Task,
        written: WrittenTask,
        offset: usize,
    ) -> Result<TaskMap, DatasetError> {
        let is_class = written.names.is_some() || written.positive.is_some();
        let columns = match written.from {
            Some(WrittenFrom::Pose(WrittenPose { t, q })) if !is_class => {
                t.into_iter().chain(q).collect::<Vec<_>>()
            }
            Some(WrittenFrom::Matrix(WrittenMatrix { t, m })) if !is_class => {
                t.into_iter().chain(m).collect()
            }
            _ => {
                let problem = "a pose needs `from = { t = [\"x\", \"y\", \"z\"], q = [\"qx\", \"qy\", \"qz\", \"qw\"] }`; remove `names` and `positive`";
                return Err(self.at(offset, problem));
            }
        };
        let columns = columns.into_iter();
        task.from = columns.map(ColumnName::into_name).collect();
        let units = self.units_of_positions(written.unit.as_ref(), &task.name, offset)?;
        task.over = written.over;
        task.frame = written.frame;
        if let Some(thresholds) = written.thresholds {
            let at = thresholds.span().start;
            let WrittenThresholds { t, r } = thresholds.into_inner();
            for limits in [&t, &r] {
                if let Some(problem) = problem_of_limits(limits) {
                    return Err(self.at(at, &problem));
                }
            }
            task.thresholds = Some(PoseThresholds::new(t, r));
        }
        Ok(TaskMap {
            task,
            units,
            array: None,
        })
    }

    /// Units of x, y and z of the task called `name`.
    fn units_of_positions(
        &self,
        written: Option<&Spanned<WrittenUnits>>,
        name: &str,
        offset: usize,
    ) -> Result<Vec<SourceUnit>, DatasetError> {
        let written = written.ok_or_else(|| {
            let problem = format!("[task.{name}] needs `unit` of its positions, such as \"mm\"");
            self.at(offset, &problem)
        })?;
        let at = written.span().start;
        let symbols = match written.get_ref() {
            WrittenUnits::One(symbol) => vec![symbol; 3],
            WrittenUnits::Several(symbols) => match symbols.as_slice() {
                [only] => vec![only; 3],
                symbols => symbols.iter().collect(),
            },
        };
        if symbols.len() != 3 {
            return Err(self.at(
                at,
                "invalid `unit`, expected one unit of length, or one for each of x, y and z",
            ));
        }
        let units = symbols.into_iter();
        units.map(|symbol| self.length(symbol, at)).collect()
    }

    /// Unit of length with the symbol `symbol`. `at` is the offset of the symbol in the map.
    fn length(&self, symbol: &str, at: usize) -> Result<SourceUnit, DatasetError> {
        let unit = SourceUnit::parse(symbol).map_err(|error| error.to_string());
        let unit = unit.and_then(|unit| match unit.unit() {
            Unit::Millimetre => Ok(unit),
            _ => Err(format!(
                "`{}` is not a unit of length, such as \"mm\" or \"m\"",
                shown(symbol)
            )),
        });
        unit.map_err(|problem| self.at(at, &problem))
    }
}
