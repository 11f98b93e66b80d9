//! Errors of tasks.

use taceva_core::{counted, nearest, shown};
use thiserror::Error;

/// Reason why a task refuses a definition, a sample or a merge. A row is the number of the sample in its state, from 1.
///
/// ```
/// use taceva_tasks::{Classes, TaskError};
/// let mut slip = Classes::new(["no_slip", "slip"], Some("slip"))?;
/// let refused = slip.push("stroke 1", "slpi", "slip").err().ok_or("no class")?;
/// assert!(matches!(refused, TaskError::UnknownClass { row: 1, .. }));
/// assert_eq!(
///     refused.to_string(),
///     "row 1: the truth is \"slpi\", expected a class of the task; did you mean \"slip\"?"
/// );
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Error, PartialEq)]
#[non_exhaustive]
pub enum TaskError {
    /// A class that the task does not name.
    #[error("row {row}: the {column} is \"{}\", expected a class of the task{}", shown(.name), did_you_mean(.nearest))]
    UnknownClass {
        /// Number of the sample, from 1.
        row: u64,
        /// `truth` or `prediction`.
        column: &'static str,
        /// Name found.
        name: String,
        /// Nearest name of a class of the task; `None` if no name is similar.
        nearest: Option<String>,
    },
    /// A position beyond the classes of the task.
    #[error("row {row}: the {column} is position {position}, expected less than {classes}")]
    UnknownPosition {
        /// Number of the sample, from 1.
        row: u64,
        /// `truth` or `prediction`.
        column: &'static str,
        /// Position found.
        position: u64,
        /// Number of classes.
        classes: u64,
    },
    /// Fewer than two names.
    #[error("the task has {}, expected two or more", names(.have))]
    TooFewNames {
        /// Number of names.
        have: usize,
    },
    /// Two classes with the same name.
    #[error("names: \"{}\" occurs twice, expected each name once", shown(.name))]
    SameName {
        /// Repeated name.
        name: String,
    },
    /// A positive class that the task does not name.
    #[error("positive is \"{}\", expected a class of the task{}", shown(.name), did_you_mean(.nearest))]
    UnknownPositive {
        /// Name found.
        name: String,
        /// Nearest name of a class of the task; `None` if no name is similar.
        nearest: Option<String>,
    },
    /// A number that is not finite.
    #[error("row {row}: {column} is {value}, expected a finite number")]
    NotFinite {
        /// Number of the sample, from 1.
        row: u64,
        /// Name of the number, such as `score`.
        column: String,
        /// Value found.
        value: f64,
    },
    /// Scores for some of the classes only.
    #[error("row {row}: {} for {expected} classes{}; give one score for each class", scores(.have), no_score_of(.missing))]
    SomeScores {
        /// Number of the sample, from 1.
        row: u64,
        /// Number of scores found.
        have: usize,
        /// Number of classes.
        expected: usize,
        /// First class without a score; `None` for too many scores.
        missing: Option<String>,
    },
    /// Columns of different length.
    #[error("{column} has {}, expected {expected}, as many as truths", rows(.have))]
    OtherLength {
        /// Name of the column.
        column: &'static str,
        /// Number of rows found.
        have: usize,
        /// Number of rows of the truth.
        expected: usize,
    },
    /// A stored state that no samples can produce.
    #[error("a stored state has {}, which no samples give; score the samples again", shown(.found))]
    Damaged {
        /// Invalid part of the state.
        found: String,
    },
    /// A sequence whose frames are divided among two merged states.
    #[error(
        "cluster \"{}\" has rows in both states, but onsets and a debounce need its whole sequence; divide tables between clusters",
        shown(.cluster)
    )]
    DividedSequence {
        /// Cluster of the sequence.
        cluster: String,
    },
    /// A merge of states with different definitions.
    #[error("states of different {what} do not merge: {} and {}; score both parts with the same {what}", shown(.ours), shown(.theirs))]
    OtherDefinition {
        /// Name of the part that differs, such as `names`.
        what: &'static str,
        /// Definition of the state.
        ours: String,
        /// Definition of the other state.
        theirs: String,
    },
}

impl TaskError {
    /// Error for the class `name` of `column`, which is not among `names`.
    pub(crate) fn unknown_class(
        row: u64,
        column: &'static str,
        name: &str,
        names: &[String],
    ) -> TaskError {
        TaskError::UnknownClass {
            row,
            column,
            name: name.to_owned(),
            nearest: nearest_name(name, names),
        }
    }

    /// Error for a stored state with the invalid part `found`.
    pub(crate) fn damaged(found: impl Into<String>) -> TaskError {
        TaskError::Damaged {
            found: found.into(),
        }
    }

    /// `n` + `count`, for counts of a stored state; an error from 2⁵³ on.
    pub(crate) fn checked_count(n: u64, count: u64) -> Result<u64, TaskError> {
        // Twice the number of samples occurs in formulas, and their products in 128 bits.
        let sum = n.checked_add(count).filter(|sum| *sum < 1 << 53);
        sum.ok_or_else(|| TaskError::damaged("2^53 samples or more"))
    }

    /// Error for the positive class `name`, which is not among `names`.
    pub(crate) fn unknown_positive(name: &str, names: &[String]) -> TaskError {
        TaskError::UnknownPositive {
            name: name.to_owned(),
            nearest: nearest_name(name, names),
        }
    }
}

fn nearest_name(name: &str, names: &[String]) -> Option<String> {
    nearest(name, names.iter().map(String::as_str)).map(str::to_owned)
}

/// Suggestion at the end of a message; empty without a suggestion.
fn did_you_mean(nearest: &Option<String>) -> String {
    match nearest {
        Some(name) => format!("; did you mean \"{}\"?", shown(name)),
        None => String::new(),
    }
}

fn no_score_of(missing: &Option<String>) -> String {
    match missing {
        Some(name) => format!(", none of \"{}\"", shown(name)),
        None => String::new(),
    }
}

fn names(count: &usize) -> String {
    counted(*count, "name")
}

fn rows(count: &usize) -> String {
    counted(*count, "row")
}

fn scores(count: &usize) -> String {
    counted(*count, "score")
}
