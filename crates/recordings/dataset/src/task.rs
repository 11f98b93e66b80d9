//! Tasks of a recording: labels other than measured quantities, such as slip, an object or a pose, and their definitions.

mod maps;

use std::collections::BTreeMap;

use serde::de::Error as _;
use serde::{Deserialize, Deserializer, Serialize};

pub use maps::{MapEntry, MapFacts};

/// Suffixes of the channel names of a pose: a translation, and a rotation vector.
const POSE_CHANNELS: [&str; 6] = ["tx", "ty", "tz", "rx", "ry", "rz"];

/// Prefix of the name of each column with labels of a task. Attributes and channels contain no `.`.
const PREFIX: &str = "task.";

/// Parts of a pose, in the order of storage: a position in mm and a unit quaternion.
static POSE_PARTS: [&str; 7] = ["x", "y", "z", "qx", "qy", "qz", "qw"];

/// True if the column `name` of a table contains labels of a task.
pub fn is_task_column(name: &str) -> bool {
    name.starts_with(PREFIX)
}

/// Kind of the labels of a task.
///
/// ```
/// use taceva_dataset::TaskKind;
///
/// assert_eq!(TaskKind::from_name("event"), Some(TaskKind::Event));
/// assert_eq!(TaskKind::ALL.map(TaskKind::name), ["class", "event", "outcome", "pose", "place", "depth"]);
/// ```
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum TaskKind {
    /// One of several classes, such as a material.
    Class,
    /// One of two classes that changes within a trajectory, such as slip.
    Event,
    /// One of two classes that is constant over a trajectory, such as the success of a grasp.
    Outcome,
    /// Position and orientation of an object.
    Pose,
    /// Position of a contact, without an orientation.
    Place,
    /// Depth of each pixel of a picture.
    Depth,
}

impl TaskKind {
    /// All kinds of tasks.
    pub const ALL: [TaskKind; 6] = [
        TaskKind::Class,
        TaskKind::Event,
        TaskKind::Outcome,
        TaskKind::Pose,
        TaskKind::Place,
        TaskKind::Depth,
    ];

    /// Name of the kind in import maps and headers.
    pub const fn name(self) -> &'static str {
        match self {
            TaskKind::Class => "class",
            TaskKind::Event => "event",
            TaskKind::Outcome => "outcome",
            TaskKind::Pose => "pose",
            TaskKind::Place => "place",
            TaskKind::Depth => "depth",
        }
    }

    /// True if a label is one of several classes.
    pub const fn has_classes(self) -> bool {
        matches!(self, TaskKind::Class | TaskKind::Event | TaskKind::Outcome)
    }

    /// Kind called `name`; `None` for an unknown name.
    pub fn from_name(name: &str) -> Option<TaskKind> {
        TaskKind::ALL.into_iter().find(|kind| kind.name() == name)
    }
}

/// Definition of the labels of a task.
///
/// ```
/// use taceva_dataset::{Task, TaskKind};
///
/// let mut slip = Task::new("slip", TaskKind::Event, "trajectory");
/// slip.names = vec!["no_slip".to_owned(), "slip".to_owned()];
/// slip.positive = Some("slip".to_owned());
/// assert_eq!(slip.columns(), ["task.slip"]);
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Task {
    /// Name of the task: a letter, then letters, digits or `_`.
    #[serde(skip)]
    pub name: String,
    /// Kind of the labels.
    pub kind: TaskKind,
    /// Source columns of the labels; empty if nothing was imported.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub from: Vec<String>,
    /// Names of the classes, in the order of their positions; empty for kinds without classes.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub names: Vec<String>,
    /// Name of the class that a model should find; `None` if no class is preferred.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub positive: Option<String>,
    /// Id or attribute that is equal in similar samples, such as a trajectory. Intervals and splits treat these samples as one cluster.
    pub cluster: String,
    /// True if the import map states that delays of this task are in seconds.
    #[serde(rename = "time", default, skip_serializing_if = "std::ops::Not::not")]
    pub is_timed: bool,
    /// Rule that made the labels, in words; `None` if not stated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub rule: Option<String>,
    /// Number of frames between the two poses of a pose change; `None` for other tasks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub over: Option<u32>,
    /// Coordinate frame of the poses, in words; `None` if not stated.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub frame: Option<String>,
    /// Limits between the classes of a pose change; `None` without such classes.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub thresholds: Option<PoseThresholds>,
    /// Meaning of the numbers of depth maps; `None` for other tasks.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub maps: Option<MapFacts>,
}

/// Limits between the classes of a pose change, as decimals. A decimal has no rounding, so limits of different programs compare exactly.
///
/// ```
/// let thresholds = taceva_dataset::PoseThresholds::new(vec!["0.5".to_owned()], vec!["2".to_owned()]);
/// assert_eq!(thresholds.t, ["0.5"]);
/// ```
///
/// # Units
/// `t` in mm, `r` in degrees.
#[non_exhaustive]
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct PoseThresholds {
    /// Limits of a translation, in ascending order.
    pub t: Vec<String>,
    /// Limits of a rotation, in ascending order.
    pub r: Vec<String>,
}

impl PoseThresholds {
    /// Limits `t` of a translation and `r` of a rotation.
    pub fn new(t: Vec<String>, r: Vec<String>) -> PoseThresholds {
        PoseThresholds { t, r }
    }
}

impl Task {
    /// Task `name` without classes. Samples with the same value of `cluster` are similar.
    pub fn new(name: impl Into<String>, kind: TaskKind, cluster: impl Into<String>) -> Task {
        Task {
            name: name.into(),
            kind,
            from: Vec::new(),
            names: Vec::new(),
            positive: None,
            cluster: cluster.into(),
            is_timed: false,
            rule: None,
            over: None,
            frame: None,
            thresholds: None,
            maps: None,
        }
    }

    /// Names of the columns with the labels in the table of a dataset.
    pub fn columns(&self) -> Vec<String> {
        let column = format!("{PREFIX}{}", self.name);
        let parts: &[&str] = match self.kind {
            TaskKind::Pose => &POSE_PARTS,
            TaskKind::Place => &POSE_PARTS[..3],
            TaskKind::Depth => return vec![column.clone(), format!("{column}.sha256")],
            _ => return vec![column],
        };
        let parts = parts.iter();
        parts.map(|part| format!("{column}.{part}")).collect()
    }

    /// Channels of the labels after [`Dataset::of_task`](crate::Dataset::of_task): the position of the class, or translation and rotation vector of a
    /// pose. Tasks of places and of depth maps have no such channels.
    ///
    /// ```
    /// use taceva_dataset::{Task, TaskKind};
    /// let moved = Task::new("moved", TaskKind::Pose, "trajectory");
    /// assert_eq!(moved.channels()[3], "moved_rx");
    /// ```
    pub fn channels(&self) -> Vec<String> {
        match self.kind {
            TaskKind::Pose => {
                let ends = POSE_CHANNELS.iter();
                ends.map(|end| format!("{}_{end}", self.name)).collect()
            }
            TaskKind::Place | TaskKind::Depth => Vec::new(),
            _ => vec![self.name.clone()],
        }
    }

    /// Definition as one line, without the source columns. Labels of two recordings have the same meaning if their definitions are equal.
    pub fn definition(&self) -> String {
        let own = Task {
            from: Vec::new(),
            ..self.clone()
        };
        let text = toml::to_string(&own).expect("texts and numbers can be written as TOML");
        let lines: Vec<&str> = text.lines().filter(|line| !line.is_empty()).collect();
        format!("{}: {}", self.name, lines.join(", "))
    }
}

/// Label of a task in one row.
///
/// ```
/// use taceva_dataset::TaskLabel;
///
/// let turned = TaskLabel::Pose([1.0, 0.0, 0.0, 0.0, 0.0, 0.6, 0.8]);
/// assert_eq!(turned.quaternion_norm(), Some(1.0));
/// assert_eq!(TaskLabel::Class(1).quaternion_norm(), None);
/// ```
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TaskLabel {
    /// Index of the class in the names of the task, from 0.
    Class(u32),
    /// Position x, y, z in mm, and quaternion x, y, z, w.
    Pose([f64; 7]),
    /// Position x, y, z in mm.
    Place([f64; 3]),
    /// Depth map in the pack of the task.
    Map(MapEntry),
}

impl TaskLabel {
    /// Maximum deviation of the norm of a quaternion from 1. Quaternions in single precision deviate less.
    pub const NORM_TOLERANCE: f64 = 1e-6;

    /// Norm of the quaternion of a pose; `None` for other labels.
    pub fn quaternion_norm(&self) -> Option<f64> {
        let TaskLabel::Pose(pose) = self else {
            return None;
        };
        let squares = pose[3..].iter().map(|part| part * part);
        Some(squares.sum::<f64>().sqrt())
    }

    /// Pose of seven numbers, or place of three; `None` for another count.
    pub(crate) fn of_numbers(numbers: &[f64]) -> Option<TaskLabel> {
        if let Ok(place) = <[f64; 3]>::try_from(numbers) {
            return Some(TaskLabel::Place(place));
        }
        <[f64; 7]>::try_from(numbers).ok().map(TaskLabel::Pose)
    }
}

/// Tasks of a header by name. Tasks of unknown kinds, from a later minor version, are skipped.
pub(crate) fn known<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<BTreeMap<String, Task>, D::Error> {
    let written = BTreeMap::<String, toml::Value>::deserialize(deserializer)?;
    let mut tasks = BTreeMap::new();
    for (name, value) in written {
        let kind = value.get("kind").and_then(toml::Value::as_str);
        if kind.is_none_or(|kind| TaskKind::from_name(kind).is_some()) {
            let task: Task = value.try_into().map_err(D::Error::custom)?;
            let named = Task {
                name: name.clone(),
                ..task
            };
            tasks.insert(name, named);
        }
    }
    Ok(tasks)
}
