//! Labels of tasks in a row: positions of classes, and poses.

use super::MappedTable;
use crate::error::{ImportError, table_error};
use crate::import::map::{TaskMap, no_name};
use taceva_dataset::internal::listed;
use taceva_dataset::{Row, Task, TaskKind, TaskLabel};

impl MappedTable<'_> {
    /// Labels of all tasks in row `row`. `read` has the ids and attributes of this row.
    pub(super) fn labels_of_tasks(
        &self,
        row: usize,
        read: &Row,
    ) -> Result<Vec<Option<TaskLabel>>, ImportError> {
        let tasks = self.map.tasks.iter().zip(&self.tasks);
        let labels = tasks.map(|(map, columns)| {
            let label = match (map.task.kind, columns.as_slice()) {
                (TaskKind::Pose, columns) => self.pose(row, columns, map)?,
                (_, [column, ..]) => self.class_of_task(row, *column, &map.task)?,
                (_, []) => None,
            };
            match label.is_some() && !self.has_cluster(read, &map.task.cluster) {
                false => Ok(label),
                true => Err(table_error!(
                    self.place(row),
                    "[task.{}] has a label here, but its cluster `{}` is empty: fill the cell, or name another `cluster`",
                    map.task.name,
                    map.task.cluster
                )),
            }
        });
        labels.collect()
    }

    /// Class in a cell that contains a name or a position. If one of two classes is positive, the cell may also contain `true` or `false`.
    fn class_of_task(
        &self,
        row: usize,
        column: usize,
        task: &Task,
    ) -> Result<Option<TaskLabel>, ImportError> {
        let cell = self.table.cell(row, column);
        if cell.is_empty() {
            return Ok(None);
        }
        let names = &task.names;
        let by_name = names.iter().position(|name| name == cell);
        let by_position = || {
            let position = cell.strip_suffix(".0").unwrap_or(cell).parse::<usize>();
            position.ok().filter(|position| *position < names.len())
        };
        let by_truth = || position_of_truth(cell, task);
        let found = by_name.or_else(by_position).or_else(by_truth);
        let found = found.and_then(|position| u32::try_from(position).ok());
        match found {
            Some(position) => Ok(Some(TaskLabel::Class(position))),
            None => Err(self.wrong(row, column, &no_name(cell, names))),
        }
    }

    /// Pose in seven cells; `None` if all of them are empty.
    fn pose(
        &self,
        row: usize,
        columns: &[usize],
        map: &TaskMap,
    ) -> Result<Option<TaskLabel>, ImportError> {
        let mut pose = [0.0; 7];
        let mut empty = Vec::new();
        for (at, (number, column)) in pose.iter_mut().zip(columns).enumerate() {
            let found = match map.units.get(at) {
                Some(unit) => self.table.number_in_unit(row, *column, unit)?,
                None => self.table.number(row, *column)?,
            };
            match found {
                Some(found) => *number = found,
                None => empty.push(*column),
            }
        }
        match empty.first() {
            None => {}
            Some(_) if empty.len() == columns.len() => return Ok(None),
            Some(column) => {
                return Err(self.wrong(
                    row,
                    *column,
                    "empty, expected all seven numbers of a pose",
                ));
            }
        }
        let label = TaskLabel::Pose(pose);
        let norm = label.quaternion_norm().unwrap_or_default();
        if (norm - 1.0).abs() > TaskLabel::NORM_TOLERANCE {
            return Err(table_error!(
                self.place(row),
                "the quaternion of [task.{}] has the norm {norm}, expected 1 ± 0.000001: divide it by its norm in the file, with \
                 seven decimals or more, or name its columns in the order x, y, z, w, now {}",
                map.task.name,
                listed(&map.task.from[3..])
            ));
        }
        Ok(Some(label))
    }

    /// True if the row has a value of the id or attribute `cluster`.
    fn has_cluster(&self, read: &Row, cluster: &str) -> bool {
        match cluster {
            "sample" => true,
            "point_id" => read.point_id.is_some(),
            "unit_id" => read.unit_id.is_some(),
            "scene" => read.scene.is_some(),
            "repeat" => read.repeat.is_some(),
            "part" => read.part.is_some(),
            "source_table" => read.source_table.is_some(),
            name => {
                let mut names = self.map.attributes.keys().chain(self.map.classes.keys());
                let at = names.position(|known| known == name);
                at.is_some_and(|at| read.attributes[at].is_some())
            }
        }
    }
}

/// Position of the class for a cell `true` (the positive class) or `false` (the other class), unless a class has this name. `None` for other cells.
fn position_of_truth(cell: &str, task: &Task) -> Option<usize> {
    let is_true = cell.eq_ignore_ascii_case("true");
    if !is_true && !cell.eq_ignore_ascii_case("false") {
        return None;
    }
    let mut names = task.names.iter();
    let named = names.position(|name| name.eq_ignore_ascii_case(cell));
    named.or_else(|| {
        let positive = task.positive.as_ref()?;
        let [first, _] = task.names.as_slice() else {
            return None;
        };
        Some(usize::from((first == positive) != is_true))
    })
}
