//! Why a split cannot be.

use super::fold_spec::FoldGroups;
use super::part::Part;
use crate::settings::Suggestion;

/// Why a recording cannot be split as asked.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SplitError {
    /// A word that names no split.
    #[error("no split is called `{given}`, {suggestion}", given = taceva_core::shown(given))]
    Kind {
        /// The word.
        given: String,
        /// What it may have been meant to be.
        suggestion: Suggestion,
    },
    /// Values of a column that are not assigned as they should be.
    #[error(
        "`{found}`: expected by-column:NAME, by-column:NAME=train:1,2;val:3;test:4 or by-recording=train:a,b;test:c, with train and test", found = taceva_core::shown(found)
    )]
    Assignment {
        /// What was found instead.
        found: String,
    },
    /// A value in two parts.
    #[error("value `{value}` is assigned twice", value = taceva_core::shown(value))]
    Twice {
        /// The value.
        value: String,
    },
    /// A number of folds that is none.
    #[error("cv:{found}: expected a number of folds from 2, such as cv:5, cv:5 by-point or loo by-column:object", found = taceva_core::shown(found))]
    Folds {
        /// The text in place of the number.
        found: String,
    },
    /// Fewer groups than folds.
    #[error(
        "{folds} folds, but the recording has {groups} groups{}; name fewer folds, or another --split",
        by_words(by)
    )]
    FewGroups {
        /// Groups of the recording.
        groups: usize,
        /// Folds that were asked for.
        folds: usize,
        /// Samples that stay together.
        by: FoldGroups,
    },
    /// Shares of a text that do not come to a whole.
    #[error("`{found}` comes to {sum}: expected shares that come to 100, such as 70/20/10", found = taceva_core::shown(found))]
    Sum {
        /// The shares as given.
        found: String,
        /// Their sum.
        sum: f64,
    },
    /// Blocks of time where nothing orders the samples in time.
    #[error(
        "split by-block: the recording has too few samples in a row for blocks of time; use random, or name a column with by-column:NAME"
    )]
    NoBlocks,
    /// Shares that are no shares.
    #[error("fractions {given:?}: expected numbers from 0, the first above 0")]
    Fractions {
        /// The shares as given.
        given: [f64; 3],
    },
    /// A list that is shorter or longer than the recording.
    #[error("{what}: {found} values for {rows} samples")]
    Length {
        /// The list.
        what: String,
        /// Its length.
        found: usize,
        /// The number of samples.
        rows: usize,
    },
    /// Too few samples or clusters for one a part.
    #[error("{found} {what} are too few for one in each part")]
    Few {
        /// What would be shared out.
        what: &'static str,
        /// How many there are.
        found: usize,
    },
    /// A part that is needed and has no sample.
    #[error("the part `{part}` has no sample")]
    Empty {
        /// The part.
        part: Part,
    },
    /// The recording names no contact points.
    #[error("split by-point: the recording names no `point_id`")]
    NoPoints,
    /// Nobody wrote down times.
    #[error("split chronological: the recording has no times")]
    NoTimes,
    /// A time that is no number.
    #[error("row {row}: the time is not finite")]
    Time {
        /// The row, counted from 0.
        row: usize,
    },
    /// A column that the recording lacks.
    #[error("split by-column: no column `{name}`, {suggestion}", name = taceva_core::shown(name))]
    NoColumn {
        /// The name as given.
        name: String,
        /// What it may have been meant to be.
        suggestion: Suggestion,
    },
    /// A value that no sample has.
    #[error("split by-column: no sample has `{column}` = `{value}`, {suggestion}", column = taceva_core::shown(column), value = taceva_core::shown(value))]
    NoValue {
        /// The column.
        column: String,
        /// The value.
        value: String,
        /// What it may have been meant to be.
        suggestion: Suggestion,
    },
    /// A split of several recordings, and there is one.
    #[error("split {split}: there is one recording; name two or more")]
    NoRecordings {
        /// The split.
        split: &'static str,
    },
    /// A recording that is not among those that are divided.
    #[error("split by-recording: no recording is called `{name}`, {suggestion}", name = taceva_core::shown(name))]
    NoRecording {
        /// The name as given.
        name: String,
        /// What it may have been meant to be.
        suggestion: Suggestion,
    },
    /// A split that divides once for each recording, where one division is asked for.
    #[error(
        "split {split} fits a model for each fold: `evaluate` does, and `fit` where it validates; one model is fitted with `all`, or with a \
         split that keeps a test part"
    )]
    ManyFolds {
        /// The split.
        split: String,
    },
    /// Some samples have no declared part, or none has.
    #[error(
        "split declared: not every sample has a part; fill each cell of the column that `part` of `[ids]` names, or use another split"
    )]
    NoParts,
    /// A declared part that is none.
    #[error("row {row}: part `{found}`, expected train, val, validation or test", found = taceva_core::shown(found))]
    Part {
        /// The row, counted from 0.
        row: usize,
        /// What it declares.
        found: String,
    },
}

fn by_words(by: &FoldGroups) -> String {
    match by {
        FoldGroups::Detected => String::new(),
        by => format!(" ({by})"),
    }
}
