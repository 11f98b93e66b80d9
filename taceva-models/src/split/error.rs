//! Errors of splits.

use super::fold_spec::FoldGroups;
use super::part::Part;
use crate::settings::Suggestion;

/// Error of splitting a recording.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SplitError {
    /// The word names no split.
    #[error("no split is called `{given}`, {suggestion}", given = taceva_core::shown(given))]
    Kind {
        /// Word given.
        given: String,
        /// Suggested splits.
        suggestion: Suggestion,
    },
    /// The text that lists column values or recordings for each part has the wrong format.
    #[error(
        "`{found}`: expected by-column:NAME, by-column:NAME=train:1,2;val:3;test:4 or by-recording=train:a,b;test:c, with train and test", found = taceva_core::shown(found)
    )]
    Assignment {
        /// Text found.
        found: String,
    },
    /// A value is assigned to two parts.
    #[error("value `{value}` is assigned twice, expected once", value = taceva_core::shown(value))]
    Twice {
        /// Repeated value.
        value: String,
    },
    /// The number of folds is invalid.
    #[error("cv:{found}: expected a number of folds from 2, such as cv:5, cv:5 by-point or loo by-column:object", found = taceva_core::shown(found))]
    Folds {
        /// Text found.
        found: String,
    },
    /// There are fewer groups than folds.
    #[error(
        "{folds} folds, but the recording has {groups} groups{}; use fewer folds or another --split",
        by_words(by)
    )]
    FewGroups {
        /// Number of groups.
        groups: usize,
        /// Number of folds.
        folds: usize,
        /// Kind of the groups.
        by: FoldGroups,
    },
    /// The shares do not add up to 100 or 1.
    #[error("`{found}` adds up to {sum}: expected shares that add up to 100, such as 70/20/10", found = taceva_core::shown(found))]
    Sum {
        /// Shares as given.
        found: String,
        /// Sum of the shares.
        sum: f64,
    },
    /// The recording has too few consecutive samples for blocks of time.
    #[error(
        "split by-block: the recording has too few consecutive samples for blocks of time; use random, or name a column with \
            by-column:NAME"
    )]
    NoBlocks,
    /// A share is negative or not finite, or the training share is 0.
    #[error("fractions {given:?}: expected numbers of at least 0, the first above 0")]
    Fractions {
        /// Shares as given.
        given: [f64; 3],
    },
    /// A list with one value per sample is longer or shorter than the recording.
    #[error("{what}: {found} values for {rows} samples")]
    Length {
        /// Name of the list.
        what: String,
        /// Length of the list.
        found: usize,
        /// Number of samples.
        rows: usize,
    },
    /// There are too few samples or clusters to place one in each part.
    #[error(
        "{found} {what} are too few for one in each part{}",
        if *found == 0 { "; in a run, this means that no press touched the gel" } else { "" }
    )]
    Few {
        /// Kind of the clusters.
        what: &'static str,
        /// Number of clusters.
        found: usize,
    },
    /// A required part is empty.
    #[error("the part `{part}` has no sample: change the shares of the split")]
    Empty {
        /// Empty part.
        part: Part,
    },
    /// The recording names no contact points.
    #[error(
        "split by-point: the recording names no `point_id`: name the column of contact points under [ids] of the map, or split by-column:NAME or by-block"
    )]
    NoPoints,
    /// The recording has no times.
    #[error("split chronological: the recording has no times")]
    NoTimes,
    /// A time is not finite.
    #[error("row {row}: the time is not finite")]
    Time {
        /// Row, counted from 0.
        row: usize,
    },
    /// The recording has no column of the given name.
    #[error("split by-column: no column `{name}`, {suggestion}", name = taceva_core::shown(name))]
    NoColumn {
        /// Name that was given.
        name: String,
        /// Suggested columns.
        suggestion: Suggestion,
    },
    /// No sample has the given value in the column.
    #[error("split by-column: no sample has `{column}` = `{value}`, {suggestion}", column = taceva_core::shown(column), value = taceva_core::shown(value))]
    NoValue {
        /// Name of the column.
        column: String,
        /// Value that was given.
        value: String,
        /// Suggested values.
        suggestion: Suggestion,
    },
    /// The split needs several recordings, but there is only one recording.
    #[error("split {split}: there is one recording; name two or more")]
    NoRecordings {
        /// Name of the split.
        split: &'static str,
    },
    /// No recording has the given name.
    #[error("split by-recording: no recording is called `{name}`, {suggestion}", name = taceva_core::shown(name))]
    NoRecording {
        /// Name that was given.
        name: String,
        /// Suggested recordings.
        suggestion: Suggestion,
    },
    /// The split has several folds, but a single fitted model is needed.
    #[error(
        "split {split} fits a model for each fold, but one model is needed: use `all` or a split with a test part, or score all folds with \
            `evaluate`"
    )]
    ManyFolds {
        /// Name of the split.
        split: String,
    },
    /// The recording declares no part for some samples.
    #[error(
        "split declared: not every sample has a part; fill each cell of the column that `part` of `[ids]` names, or use another split"
    )]
    NoParts,
    /// The recording declares a part by an unknown name.
    #[error("row {row}: part `{found}`, expected train, val, validation or test", found = taceva_core::shown(found))]
    Part {
        /// Row, counted from 0.
        row: usize,
        /// Text found.
        found: String,
    },
}

fn by_words(by: &FoldGroups) -> String {
    match by {
        FoldGroups::Detected => String::new(),
        by => format!(" ({by})"),
    }
}
