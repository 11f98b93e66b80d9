//! Tasks of a dataset: their labels by row, and the cluster of each row.

use taceva_core::{Channels, Column, nearest, shown};

use super::Dataset;
use super::union::SEPARATOR;
use crate::digest::{Digest, PartsDigest};
use crate::error::DatasetError;
use crate::table::{Table, TaskColumn};
use crate::task::{Task, TaskKind, TaskLabel};

/// Columns whose values [`Dataset::joined`] makes distinct between recordings.
const DISTINCT: [&str; 2] = ["sample", "point_id"];

impl Dataset {
    /// Labels of each task, by name; empty for a recording without tasks.
    pub fn tasks(&self) -> &[TaskColumn] {
        self.table.tasks()
    }

    /// Cluster of each row for `task`. Rows of the same cluster are similar. In joined recordings, the name of the recording precedes the name of the
    /// cluster.
    pub fn clusters_of(&self, task: &Task) -> Vec<Option<String>> {
        let absent = || vec![None; self.table.rows()];
        let mut clusters = self.table.as_text(&task.cluster).unwrap_or_else(absent);
        if DISTINCT.contains(&task.cluster.as_str()) {
            return clusters;
        }
        for recording in self.recordings() {
            for cluster in clusters[recording.rows()].iter_mut().flatten() {
                *cluster = format!("{}{SEPARATOR}{cluster}", recording.name());
            }
        }
        clusters
    }

    /// The same dataset, with all channels replaced by the [channels](Task::channels) of the task called `name`.
    ///
    /// The channels are the position of the class in the list of names, or the translation (mm) and rotation vector (degrees) of the pose.
    ///
    /// A row without a label of the task has no label. The digest depends on the dataset and on the task.
    ///
    /// # Errors
    /// [`DatasetError::Request`] for an unknown task, and for a task of places or of depth maps.
    pub fn of_task(&self, name: &str) -> Result<Dataset, DatasetError> {
        let own = self.task_called(name)?;
        if own.task().channels().is_empty() {
            return Err(DatasetError::request(
                self.path(),
                format!(
                    "the kind of the task `{}` is {}, expected a task of classes or of poses",
                    shown(name),
                    own.task().kind.name()
                ),
            ));
        }
        if !self.joined.is_empty() {
            let recordings = self.joined.iter();
            let of_task = recordings.map(|own| own.dataset().of_task(name));
            return Dataset::joined(of_task.collect::<Result<_, _>>()?);
        }
        let table = self
            .table
            .labelled_by(own)
            .map_err(|error| DatasetError::request(self.path(), error.to_string()))?;
        self.labelled(own.task(), table)
    }

    /// The same dataset with numbers of the task called `name` in the place of all channels, such as depths at places of the task's maps.
    ///
    /// `labels` has a column for each of `channels`, with a label or none for each row.
    ///
    /// # Errors
    /// [`DatasetError::Request`] for an unknown task, and for a wrong number of columns or of labels.
    pub fn with_labels(
        &self,
        name: &str,
        channels: &Channels,
        labels: &[Column],
    ) -> Result<Dataset, DatasetError> {
        let own = self.task_called(name)?;
        let rows = self.table.rows();
        if labels.len() != channels.len() || labels.iter().any(|column| column.len() != rows) {
            return Err(DatasetError::request(
                self.path(),
                format!(
                    "{} columns of labels for {} channels of the task `{}`, expected one for each, with {rows} labels",
                    labels.len(),
                    channels.len(),
                    shown(name)
                ),
            ));
        }
        if !self.joined.is_empty() {
            let labelled = self.joined.iter().map(|own| {
                let labels = labels.iter().map(|column| column.slice(own.rows()));
                let labels: Vec<Column> = labels.collect();
                own.dataset().with_labels(name, channels, &labels)
            });
            return Dataset::joined(labelled.collect::<Result<_, _>>()?);
        }
        let table = self.table.with_channels(channels.clone(), labels.to_vec());
        self.labelled(own.task(), table)
    }

    /// The same recording with `table`, whose channels are labels of `task`.
    fn labelled(&self, task: &Task, table: Table) -> Result<Dataset, DatasetError> {
        let mut header = self.header.clone();
        header.channels = table.channels().clone();
        header.rotations.clear();
        header.digest = digest_of_task(header.digest, &task.name);
        for before in &mut header.extended {
            before.digest = digest_of_task(before.digest, &task.name);
        }
        Ok(Dataset {
            seen: self.seen.clone(),
            labelled_by: Some(task.clone()),
            ..Dataset::of(self.folder.again()?, header, table)
        })
    }

    /// Labels of the task called `name`.
    pub(super) fn task_called(&self, name: &str) -> Result<&TaskColumn, DatasetError> {
        let own = self.table.task(name);
        own.ok_or_else(|| self.unknown_task(name))
    }

    /// The same dataset with the additional task `task`. `labels` contains the class or the pose of each row, or `None` for no label.
    ///
    /// # Errors
    /// [`DatasetError::Request`] for joined recordings, a duplicate task name, a wrong number of labels, a label of another kind than the task, or
    /// an unknown class.
    pub fn with_task(
        &self,
        task: Task,
        labels: &[Option<TaskLabel>],
    ) -> Result<Dataset, DatasetError> {
        if self.table.task(&task.name).is_some() {
            let name = shown(&task.name);
            let problem = format!("the recording has a task `{name}`, expected another name");
            return Err(DatasetError::request(self.path(), problem));
        }
        let suits = |label: &TaskLabel| match label {
            TaskLabel::Class(class) => {
                task.kind.has_classes() && (*class as usize) < task.names.len()
            }
            TaskLabel::Pose(_) => task.kind == TaskKind::Pose,
            TaskLabel::Place(_) | TaskLabel::Map(_) => false,
        };
        let do_all_suit = labels.iter().flatten().all(suits);
        if !self.joined.is_empty() || labels.len() != self.table.rows() || !do_all_suit {
            return Err(DatasetError::request(
                self.path(),
                format!(
                    "the task `{}` has {} labels, expected {}, one per row of a single recording: a class, a pose or none",
                    shown(&task.name),
                    labels.len(),
                    self.table.rows()
                ),
            ));
        }
        let table = self.table.with_labels(task, labels);
        let mut header = self.header.clone();
        header.digest = table.with_tasks_digest(header.digest);
        Ok(Dataset {
            seen: self.seen.clone(),
            ..Dataset::of(self.folder.again()?, header, table)
        })
    }

    /// Task whose labels replace the channels, after [`of_task`](Dataset::of_task) or [`with_labels`](Dataset::with_labels); `None` for measured channels.
    pub fn labelled_by(&self) -> Option<&Task> {
        let first = self.joined.first();
        let of_first = first.and_then(|own| own.dataset().labelled_by());
        self.labelled_by.as_ref().or(of_first)
    }

    fn unknown_task(&self, name: &str) -> DatasetError {
        let known: Vec<&str> = self
            .tasks()
            .iter()
            .map(|own| own.task().name.as_str())
            .collect();
        let problem = match known.as_slice() {
            [] => "the recording has no task: state `[task.NAME]` in the map and import again"
                .to_owned(),
            _ => {
                let meant = nearest(name, known.iter().copied())
                    .map_or_else(String::new, |task| format!("; did you mean `{task}`?"));
                format!(
                    "no task `{}`, expected one of {}{meant}",
                    shown(name),
                    known.join(", ")
                )
            }
        };
        DatasetError::request(self.path(), problem)
    }
}

/// Digest of a dataset whose channels are the labels of `task`.
fn digest_of_task(dataset: Digest, task: &str) -> Digest {
    let mut digest = PartsDigest::default();
    digest.part(b"taceva.dataset/1 classes of");
    digest.fixed(dataset.as_bytes());
    digest.part(task.as_bytes());
    digest.finish()
}
