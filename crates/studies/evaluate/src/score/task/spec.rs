//! Tasks as a caller writes them: `slip=event:positive=slip:names=no_slip|slip`.

use std::str::FromStr;

use taceva_core::{SourceUnit, Unit, nearest, shown};
use taceva_dataset::{PoseThresholds, TaskKind};

use crate::error::EvaluateError;

/// A task of two tables: its column, its kind, and its classes.
///
/// ```
/// use taceva_dataset::TaskKind;
/// use taceva_evaluate::TaskSpec;
/// let slip: TaskSpec = "slip=event:positive=slip:names=no_slip|slip".parse()?;
/// assert_eq!((slip.name.as_str(), slip.kind), ("slip", TaskKind::Event));
/// assert_eq!(slip.positive.as_deref(), Some("slip"));
/// let refused = "slip=evnt".parse::<TaskSpec>();
/// assert!(refused.is_err_and(|error| error.contains("did you mean event")));
/// # Ok::<(), String>(())
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct TaskSpec {
    /// Name of the task, which is the name of its column.
    pub name: String,
    /// Kind of the task.
    pub kind: TaskKind,
    /// Class that F1, precision and recall describe; `None` if no class is positive.
    pub positive: Option<String>,
    /// Classes in their order; empty to use the names in both tables.
    pub names: Vec<String>,
    /// Thresholds between the classes of a pose: `t` along x and y in mm, and `r` of the yaw in degrees. `None` scores a pose only by its errors.
    pub thresholds: Option<PoseThresholds>,
    /// Unit of predicted depths, places, or translations of poses; `None` for mm.
    pub unit: Option<String>,
    /// Depth above which a pixel is in contact, mm, as a decimal; `None` for 0.02.
    pub gate: Option<String>,
}

/// Form of a task, for messages.
const FORM: &str = "expected NAME=KIND[:positive=CLASS][:names=A|B][:t=MM|MM][:r=DEG|DEG][:unit=UNIT][:gate=MM], such as \
     slip=event:positive=slip, moved=pose:t=0.1|0.5|1:r=0.2|0.5|1 or shape=depth:unit=um";

impl FromStr for TaskSpec {
    type Err = String;

    fn from_str(word: &str) -> Result<TaskSpec, String> {
        let mut parts = word.split(':');
        let (name, kind) = parts
            .next()
            .and_then(|first| first.split_once('='))
            .filter(|(name, _)| !name.is_empty())
            .ok_or_else(|| format!("`{}`: {FORM}", shown(word)))?;
        let mut spec = TaskSpec {
            name: name.to_owned(),
            kind: kind_of(kind)?,
            positive: None,
            names: Vec::new(),
            thresholds: None,
            unit: None,
            gate: None,
        };
        for part in parts {
            match part.split_once('=') {
                Some(("positive", class)) if !class.is_empty() => {
                    spec.positive = Some(class.trim().to_owned());
                }
                Some(("names", names)) if !names.is_empty() => {
                    spec.names = listed(names);
                }
                Some(("t", cuts)) if !cuts.is_empty() => {
                    spec.thresholds.get_or_insert_default().t = listed(cuts);
                }
                Some(("r", cuts)) if !cuts.is_empty() => {
                    spec.thresholds.get_or_insert_default().r = listed(cuts);
                }
                Some(("unit", unit)) if !unit.is_empty() => spec.unit = Some(unit.to_owned()),
                Some(("gate", gate)) if !gate.is_empty() => spec.gate = Some(gate.to_owned()),
                _ => return Err(format!("`{}` of `{}`: {FORM}", shown(part), shown(word))),
            }
        }
        spec.check()?;
        Ok(spec)
    }
}

impl TaskSpec {
    /// Unit of predicted lengths.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] for an unknown unit, or a unit of another quantity than length.
    pub(super) fn length_unit(&self) -> Result<SourceUnit, EvaluateError> {
        let symbol = self.unit.as_deref().unwrap_or("mm");
        let unit = SourceUnit::parse(symbol).ok();
        let unit = unit.filter(|unit| unit.unit() == Unit::Millimetre);
        unit.ok_or_else(|| {
            EvaluateError::Request(format!(
                "task `{}`: `unit={}` is not a unit of length, such as mm or um",
                shown(&self.name),
                shown(symbol)
            ))
        })
    }

    fn check(&self) -> Result<(), String> {
        let name = shown(&self.name);
        let has_classes = self.positive.is_some() || !self.names.is_empty();
        match self.kind {
            TaskKind::Place | TaskKind::Depth if has_classes || self.thresholds.is_some() => {
                Err(format!(
                    "`{name}`: a task of the kind {} has neither classes nor thresholds; omit `positive`, `names`, `t` and `r`",
                    self.kind.name()
                ))
            }
            kind if self.gate.is_some() && kind != TaskKind::Depth => Err(format!(
                "`{name}`: `gate` applies to depth maps, but the kind of the task is {}",
                kind.name()
            )),
            kind if self.unit.is_some() && kind.has_classes() => Err(format!(
                "`{name}`: `unit` applies to depths, places and poses, but the kind of the task is {}",
                kind.name()
            )),
            TaskKind::Pose if has_classes => Err(format!(
                "`{name}`: a pose has no classes; omit `positive` and `names`"
            )),
            _ if self.names.iter().any(String::is_empty) => Err(format!(
                "`{name}`: an empty name in `names`, expected classes with a single | between them"
            )),
            TaskKind::Class | TaskKind::Event | TaskKind::Outcome if self.thresholds.is_some() => {
                Err(format!(
                    "`{name}`: `t` and `r` are thresholds of a pose, but the kind of the task is {}",
                    self.kind.name()
                ))
            }
            TaskKind::Event | TaskKind::Outcome if self.positive.is_none() => Err(format!(
                "`{name}`: no positive class; an {} needs one, such as {name}={}:positive=CLASS",
                self.kind.name(),
                self.kind.name()
            )),
            _ => Ok(()),
        }
    }
}

fn listed(words: &str) -> Vec<String> {
    words
        .split('|')
        .map(|word| word.trim().to_owned())
        .collect()
}

fn kind_of(word: &str) -> Result<TaskKind, String> {
    TaskKind::from_name(word).ok_or_else(|| {
        let names = TaskKind::ALL.map(TaskKind::name);
        let meant =
            nearest(word, names).map_or_else(String::new, |kind| format!("; did you mean {kind}?"));
        format!(
            "`{}`: expected a kind of task among {}{meant}",
            shown(word),
            names.join(", ")
        )
    })
}
