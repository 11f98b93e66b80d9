//! Labels of tasks, in one column for classes, in seven for poses, in three for places, and in two for depth maps.

use taceva_core::{Channel, ChannelError, Channels, Column, Unit};

use super::{Cells, NamedColumn, Table};
use crate::digest::{Digest, PartsDigest};
use crate::rotation_vector::RotationVector;
use crate::task::{MapEntry, Task, TaskKind, TaskLabel};

/// Labels of one task, one per row.
///
/// ```
/// use taceva_core::Channels;
/// use taceva_dataset::{Row, Table, Task, TaskKind, TaskLabel};
///
/// let mut slip = Task::new("slip", TaskKind::Event, "point_id");
/// slip.names = vec!["no_slip".to_owned(), "slip".to_owned()];
/// let mut table = Table::new(Channels::default(), Vec::new()).with_tasks([slip]);
/// let mut row = Row::new("stroke 1");
/// row.tasks = vec![Some(TaskLabel::Class(1))];
/// table.push(row);
/// assert_eq!(table.tasks()[0].class(0), Some("slip"));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct TaskColumn {
    task: Task,
    /// Column names on disk.
    columns: Vec<String>,
    cells: TaskCells,
}

#[derive(Clone, Debug, PartialEq)]
enum TaskCells {
    Classes(Vec<Option<u32>>),
    /// One list for each number of a pose or of a place.
    Numbers(Vec<Vec<Option<f64>>>),
    Maps(Vec<Option<MapEntry>>),
}

impl TaskColumn {
    fn new(task: Task) -> TaskColumn {
        let columns = task.columns();
        TaskColumn {
            cells: match task.kind {
                TaskKind::Pose | TaskKind::Place => {
                    TaskCells::Numbers(vec![Vec::new(); columns.len()])
                }
                TaskKind::Depth => TaskCells::Maps(Vec::new()),
                _ => TaskCells::Classes(Vec::new()),
            },
            columns,
            task,
        }
    }

    /// Definition of the labels.
    pub fn task(&self) -> &Task {
        &self.task
    }

    /// Label of a row; `None` if the row has no label.
    ///
    /// # Panics
    /// Panics if the row does not exist.
    pub fn label(&self, row: usize) -> Option<TaskLabel> {
        match &self.cells {
            TaskCells::Classes(classes) => classes[row].map(TaskLabel::Class),
            TaskCells::Numbers(parts) => {
                let numbers = parts.iter().map(|part| part[row]);
                let numbers: Option<Vec<f64>> = numbers.collect();
                TaskLabel::of_numbers(&numbers?)
            }
            TaskCells::Maps(maps) => maps[row].map(TaskLabel::Map),
        }
    }

    /// Name of the class of a row; `None` if the row has no label, and for a kind without classes.
    ///
    /// # Panics
    /// Panics if the row does not exist.
    pub fn class(&self, row: usize) -> Option<&str> {
        let TaskLabel::Class(class) = self.label(row)? else {
            return None;
        };
        self.task.names.get(class as usize).map(String::as_str)
    }

    pub(super) fn push(&mut self, label: Option<TaskLabel>) {
        match (&mut self.cells, label) {
            (TaskCells::Classes(classes), None) => classes.push(None),
            (TaskCells::Classes(classes), Some(TaskLabel::Class(class))) => {
                assert!(
                    (class as usize) < self.task.names.len(),
                    "a class of the task"
                );
                classes.push(Some(class));
            }
            (TaskCells::Numbers(parts), None) => parts.iter_mut().for_each(|part| part.push(None)),
            (TaskCells::Numbers(parts), Some(TaskLabel::Pose(pose))) if parts.len() == 7 => {
                push_each(parts, &pose);
            }
            (TaskCells::Numbers(parts), Some(TaskLabel::Place(place))) if parts.len() == 3 => {
                push_each(parts, &place);
            }
            (TaskCells::Maps(maps), None) => maps.push(None),
            (TaskCells::Maps(maps), Some(TaskLabel::Map(entry))) => maps.push(Some(entry)),
            (_, Some(_)) => panic!("a label of the kind of `{}`", self.task.name),
        }
    }

    /// Translation and rotation vector of each row, with one column for each component. Labels other than poses give no numbers.
    fn pose_columns(&self) -> Vec<Column> {
        let rows = 0..self.rows();
        let pose = |row: usize| match self.label(row)? {
            TaskLabel::Pose([x, y, z, quaternion @ ..]) => {
                let [rx, ry, rz] = RotationVector::of_quaternion(quaternion).degrees();
                Some([x, y, z, rx, ry, rz])
            }
            _ => None,
        };
        let poses: Vec<Option<[f64; 6]>> = rows.map(pose).collect();
        let part = |part: usize| column(poses.iter().map(|pose| pose.map(|pose| pose[part])));
        (0..6).map(part).collect()
    }

    fn rows(&self) -> usize {
        match &self.cells {
            TaskCells::Classes(classes) => classes.len(),
            TaskCells::Numbers(parts) => parts.first().map_or(0, Vec::len),
            TaskCells::Maps(maps) => maps.len(),
        }
    }

    pub(super) fn named_columns(&self) -> Vec<NamedColumn<'_>> {
        let cells: Vec<Cells<'_>> = match &self.cells {
            TaskCells::Classes(classes) => vec![Cells::Class(classes, &self.task.names)],
            TaskCells::Numbers(parts) => parts.iter().map(|part| Cells::Measured(part)).collect(),
            TaskCells::Maps(maps) => vec![Cells::MapPlace(maps), Cells::MapDigest(maps)],
        };
        let names = self.columns.iter();
        names
            .zip(cells)
            .map(|(name, cells)| NamedColumn { name, cells })
            .collect()
    }
}

fn push_each(parts: &mut [Vec<Option<f64>>], numbers: &[f64]) {
    for (part, number) in parts.iter_mut().zip(numbers) {
        part.push(Some(*number));
    }
}

/// Column of the given cells.
fn column(cells: impl Iterator<Item = Option<f64>>) -> Column {
    let mut column = Column::default();
    cells.for_each(|cell| column.push(cell));
    column
}

impl Table {
    /// Sets the depth map of a row for the task called `task`.
    ///
    /// # Panics
    /// Panics if the row or a task of depth maps with this name does not exist.
    #[doc(hidden)]
    pub fn set_map(&mut self, task: &str, row: usize, entry: MapEntry) {
        let mut tasks = self.tasks.iter_mut();
        let own = tasks.find(|own| own.task.name == task);
        let Some(TaskCells::Maps(maps)) = own.map(|own| &mut own.cells) else {
            panic!("a task of depth maps called `{task}`");
        };
        maps[row] = Some(entry);
    }

    /// The same table with a column for the labels of each of `tasks`, sorted by name. The table must be empty.
    ///
    /// # Panics
    /// Panics if the table has rows.
    #[must_use]
    pub fn with_tasks(mut self, tasks: impl IntoIterator<Item = Task>) -> Table {
        assert_eq!(self.rows(), 0, "no row has labels of other tasks");
        self.tasks = tasks.into_iter().map(TaskColumn::new).collect();
        self.tasks
            .sort_by(|one, other| one.task.name.cmp(&other.task.name));
        self
    }

    /// Labels of each task, by name; empty without tasks.
    pub fn tasks(&self) -> &[TaskColumn] {
        &self.tasks
    }

    /// Labels of the task called `name`; `None` for an unknown name.
    pub fn task(&self, name: &str) -> Option<&TaskColumn> {
        self.tasks.iter().find(|own| own.task.name == name)
    }

    /// The same rows, whose only channels are the [channels](Task::channels) of the task of `own`.
    ///
    /// # Errors
    /// [`ChannelError`] if the name of the task is invalid for a channel.
    pub(crate) fn labelled_by(&self, own: &TaskColumn) -> Result<Table, ChannelError> {
        let columns = match &own.cells {
            TaskCells::Classes(classes) => {
                vec![column(classes.iter().map(|class| class.map(f64::from)))]
            }
            TaskCells::Numbers(_) | TaskCells::Maps(_) => own.pose_columns(),
        };
        let units = match &own.cells {
            TaskCells::Classes(_) => [Unit::One; 6],
            TaskCells::Numbers(_) | TaskCells::Maps(_) => {
                let (mm, degree) = (Unit::Millimetre, Unit::Degree);
                [mm, mm, mm, degree, degree, degree]
            }
        };
        let names = own.task.channels();
        let named = names.iter().zip(units);
        let named = named.map(|(name, unit)| Channel::named(name, unit));
        let channels = Channels::new(named.collect::<Result<Vec<_>, _>>()?)?;
        // Channels may have another order than the names.
        let mut truth = vec![Column::default(); names.len()];
        for (name, column) in names.iter().zip(columns) {
            let position = channels.position(name);
            truth[position.expect("one of the channels")] = column;
        }
        Ok(self.with_channels(channels, truth))
    }

    /// The same rows with `channels` as the only channels, and a column of labels for each of them.
    pub(crate) fn with_channels(&self, channels: Channels, truth: Vec<Column>) -> Table {
        Table {
            channels,
            truth,
            ..self.clone()
        }
    }

    /// The same table with `labels` of the additional task `task`, all of the kind of the task.
    pub(crate) fn with_labels(&self, task: Task, labels: &[Option<TaskLabel>]) -> Table {
        let mut own = TaskColumn::new(task);
        labels.iter().for_each(|label| own.push(*label));
        let mut table = self.clone();
        table.tasks.push(own);
        table
            .tasks
            .sort_by(|one, other| one.task.name.cmp(&other.task.name));
        table
    }

    /// Digest of the dataset with the digest `dataset`, and of the labels and definitions of its tasks.
    ///
    /// The file keeps `dataset`, the digest without tasks. A reader of an earlier minor version reads no tasks, and checks that digest.
    pub(crate) fn with_tasks_digest(&self, dataset: Digest) -> Digest {
        if self.tasks.is_empty() {
            return dataset;
        }
        let mut digest = PartsDigest::default();
        digest.part(b"taceva.dataset/1 with tasks");
        digest.fixed(dataset.as_bytes());
        for own in &self.tasks {
            digest.part(own.task.definition().as_bytes());
            for column in own.named_columns() {
                // The place of a map is left out, because the digest beside it identifies the map.
                if matches!(column.cells, Cells::MapPlace(_)) {
                    continue;
                }
                for row in 0..self.rows() {
                    column.cells.digest(row, &mut digest);
                }
            }
        }
        digest.finish()
    }
}
