//! Labels of tasks in a row: positions of classes, poses, places, and files of depth maps.

use super::{MappedTable, rotation_matrix};
use crate::error::{ImportError, table_error};
use crate::import::map::{TaskMap, no_name};
use taceva_dataset::internal::listed;
use taceva_dataset::{Place, Row, Task, TaskKind, TaskLabel};

impl MappedTable<'_> {
    /// Labels of all tasks in row `row`. `read` already has the ids and attributes of this row.
    pub(super) fn labels_of_tasks(
        &self,
        row: usize,
        read: &Row,
    ) -> Result<Vec<Option<TaskLabel>>, ImportError> {
        let tasks = self.map.tasks.iter().zip(&self.tasks);
        let labels = tasks.map(|(map, columns)| {
            let label = match (map.task.kind, columns.as_slice()) {
                (TaskKind::Pose | TaskKind::Place, columns) => self.numbers(row, columns, map)?,
                // The place of a map is known once it is written.
                (TaskKind::Depth, _) => None,
                (_, [column, ..]) => self.class_of_task(row, *column, &map.task)?,
                (_, []) => None,
            };
            let has_map = match (&map.array, columns.as_slice()) {
                _ if map.task.kind != TaskKind::Depth => false,
                (None, [column, ..]) => !self.table.cell(row, *column).is_empty(),
                _ => true,
            };
            let is_labelled = label.is_some() || has_map;
            match is_labelled && !self.has_cluster(read, &map.task.cluster) {
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

    /// Label in a cell that contains the name or the position of a class. If one of two classes is positive, the cell may also contain `true` or
    /// `false`.
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

    /// Name of the file with the depth map of a row, for the task at position `task` of the map, and the place of the name; `None` for an empty cell.
    pub(in crate::import) fn map_file(&self, task: usize, row: usize) -> Option<(&str, Place)> {
        let column = *self.tasks[task].first()?;
        let name = self.table.cell(row, column);
        (!name.is_empty()).then(|| (name, self.table.place(row, column)))
    }

    /// Pose or place of a row: 7 cells for a pose, 12 for a pose with a rotation matrix, 3 for a place. `None` if all cells are empty.
    fn numbers(
        &self,
        row: usize,
        columns: &[usize],
        map: &TaskMap,
    ) -> Result<Option<TaskLabel>, ImportError> {
        let mut numbers = vec![0.0; columns.len()];
        let mut empty = Vec::new();
        for (at, (number, column)) in numbers.iter_mut().zip(columns).enumerate() {
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
                    match map.task.kind {
                        TaskKind::Place => "empty, expected all three numbers of a place",
                        _ if columns.len() == 12 => "empty, expected all twelve numbers of a pose",
                        _ => "empty, expected all seven numbers of a pose",
                    },
                ));
            }
        }
        if let Ok(place) = <[f64; 3]>::try_from(numbers.as_slice()) {
            return Ok(Some(TaskLabel::Place(place)));
        }
        if let Ok(matrix) = <[f64; 9]>::try_from(&numbers[3..]) {
            let turned = rotation_matrix::quaternion(matrix);
            let turned = turned.ok_or_else(|| {
                table_error!(
                    self.place(row),
                    "the matrix of [task.{}] is not a rotation, expected perpendicular rows of length 1 ± 0.000001 and the determinant 1: name its \
                     columns row by row, now {}",
                    map.task.name,
                    listed(&map.task.from[3..])
                )
            })?;
            numbers.truncate(3);
            numbers.extend(turned);
        }
        let Ok(pose) = <[f64; 7]>::try_from(numbers.as_slice()) else {
            return Ok(None);
        };
        let label = TaskLabel::Pose(pose);
        let norm = label.quaternion_norm().unwrap_or_default();
        if (norm - 1.0).abs() > TaskLabel::NORM_TOLERANCE {
            return Err(table_error!(
                self.place(row),
                "the quaternion of [task.{}] has the norm {norm}, expected 1 ± 0.000001: normalise it in the file, with seven decimals or more. Or name its columns in the order x, y, z, w, now {}",
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
