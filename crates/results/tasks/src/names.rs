//! Names of the classes of a task, and the positive class.

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use taceva_core::shown;

use crate::error::TaskError;

/// Names of classes in their order.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(into = "Stored", try_from = "Stored")]
pub(crate) struct Names {
    names: Vec<String>,
    positions: BTreeMap<String, u32>,
    positive: Option<u32>,
}

/// Names in a file.
#[derive(Serialize, Deserialize)]
struct Stored {
    all: Vec<String>,
    positive: Option<String>,
}

impl From<Names> for Stored {
    fn from(names: Names) -> Stored {
        Stored {
            positive: names.positive_name().map(str::to_owned),
            all: names.names,
        }
    }
}

impl TryFrom<Stored> for Names {
    type Error = TaskError;
    fn try_from(stored: Stored) -> Result<Names, TaskError> {
        Names::new(stored.all, stored.positive.as_deref())
    }
}

impl Names {
    /// Names, with the positive class if the task has a positive class.
    ///
    /// # Errors
    /// [`TaskError::TooFewNames`], [`TaskError::SameName`] or [`TaskError::UnknownPositive`].
    pub(crate) fn new<N: Into<String>>(
        names: impl IntoIterator<Item = N>,
        positive: Option<&str>,
    ) -> Result<Names, TaskError> {
        let names: Vec<String> = names.into_iter().map(Into::into).collect();
        if names.len() < 2 {
            return Err(TaskError::TooFewNames { have: names.len() });
        }
        let mut positions = BTreeMap::new();
        for (position, name) in (0..).zip(&names) {
            if positions.insert(name.clone(), position).is_some() {
                return Err(TaskError::SameName { name: name.clone() });
            }
        }
        let positive = match positive {
            Some(name) => match positions.get(name) {
                Some(position) => Some(*position),
                None => return Err(TaskError::unknown_positive(name, &names)),
            },
            None => None,
        };
        Ok(Names {
            names,
            positions,
            positive,
        })
    }

    /// All names in their order.
    pub(crate) fn all(&self) -> &[String] {
        &self.names
    }

    /// Number of classes.
    pub(crate) fn len(&self) -> usize {
        self.names.len()
    }

    /// Position of the positive class; `None` without a positive class.
    pub(crate) fn positive(&self) -> Option<usize> {
        self.positive.map(|position| position as usize)
    }

    /// Position of the positive class if there are two classes.
    pub(crate) fn positive_of_two(&self) -> Option<usize> {
        self.positive().filter(|_| self.len() == 2)
    }

    /// Name of the positive class; `None` without a positive class.
    pub(crate) fn positive_name(&self) -> Option<&str> {
        let position = self.positive()?;
        self.names.get(position).map(String::as_str)
    }

    /// Position of the class `name` in `column` of `row`.
    pub(crate) fn position(
        &self,
        row: u64,
        column: &'static str,
        name: &str,
    ) -> Result<u32, TaskError> {
        let position = self.positions.get(name).copied();
        position.ok_or_else(|| TaskError::unknown_class(row, column, name, &self.names))
    }

    /// Rejects a class position that has no name.
    pub(crate) fn check(
        &self,
        row: u64,
        column: &'static str,
        position: u32,
    ) -> Result<(), TaskError> {
        match (position as usize) < self.names.len() {
            true => Ok(()),
            false => Err(TaskError::UnknownPosition {
                row,
                column,
                position: u64::from(position),
                classes: self.names.len() as u64,
            }),
        }
    }

    /// Refuses scores that are not finite, or whose number differs from the number of classes.
    pub(crate) fn check_scores(&self, row: u64, scores: &[f64]) -> Result<(), TaskError> {
        if scores.len() != self.len() {
            return Err(TaskError::SomeScores {
                row,
                have: scores.len(),
                expected: self.len(),
                missing: self.names.get(scores.len()).cloned(),
            });
        }
        for (name, value) in self.names.iter().zip(scores) {
            if !value.is_finite() {
                return Err(TaskError::NotFinite {
                    row,
                    column: format!("the score of \"{}\"", shown(name)),
                    value: *value,
                });
            }
        }
        Ok(())
    }

    /// Refuses other names or another positive class.
    pub(crate) fn check_same(&self, other: &Names) -> Result<(), TaskError> {
        let differ = |what, ours, theirs| Err(TaskError::OtherDefinition { what, ours, theirs });
        if self.names != other.names {
            return differ("names", self.names.join(", "), other.names.join(", "));
        }
        if self.positive != other.positive {
            let positive = |of: &Names| of.positive_name().unwrap_or("none").to_owned();
            return differ("positive", positive(self), positive(other));
        }
        Ok(())
    }
}

/// Refuses definitions of `what` that differ.
pub(crate) fn same(what: &'static str, ours: String, theirs: String) -> Result<(), TaskError> {
    match ours == theirs {
        true => Ok(()),
        false => Err(TaskError::OtherDefinition { what, ours, theirs }),
    }
}
