//! Groups of samples that a division never separates, and the columns that a split reads.

use std::collections::{BTreeMap, BTreeSet};

use taceva_dataset::Dataset;
use taceva_models::{ColumnSplit, FoldGroups, Part, Split, SplitBlocks, SplitInput, SplitKind};

use crate::neighbours::{Blocks, Resemblance};
use crate::note::{Division, Neighbours, Note};
use crate::recordings;

/// Share of tested samples with a neighbour in the training part above which the report has a note.
const SHARE_BESIDE: f64 = 0.1;

/// Samples that a division does not separate by default.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Grouping {
    /// Samples of one contact point, if some points repeat.
    Points,
    /// Samples with equal values in the column of this name.
    Column(String),
    /// Blocks of time.
    Blocks,
    /// Single samples. `are_apart` is true if neighbours are known not to resemble each other.
    Samples { are_apart: bool },
}

impl Grouping {
    /// Detects the grouping of `rows` of `dataset`.
    pub(crate) fn of(dataset: &Dataset, rows: &[usize]) -> Grouping {
        if has_repeats(dataset, rows) {
            return Grouping::Points;
        }
        match Resemblance::of(dataset, rows) {
            Resemblance::Alike(Neighbours {
                column: Some(name), ..
            }) => Grouping::Column(name),
            Resemblance::Alike(_) if Blocks::of(dataset, rows).is_some() => Grouping::Blocks,
            Resemblance::Apart => Grouping::Samples { are_apart: true },
            _ => Grouping::Samples { are_apart: false },
        }
    }

    /// Kind of a single split that keeps the groups whole.
    pub(crate) fn kind(self) -> SplitKind {
        match self {
            Grouping::Points => SplitKind::ByPoint,
            Grouping::Column(column) => SplitKind::ByColumn(ColumnSplit {
                column,
                parts: BTreeMap::new(),
            }),
            Grouping::Blocks => SplitKind::ByBlock,
            Grouping::Samples { .. } => SplitKind::Random,
        }
    }

    /// Groups that each fold by this grouping keeps whole.
    pub(crate) fn folds(self) -> FoldGroups {
        match self {
            Grouping::Points => FoldGroups::Points,
            Grouping::Column(column) => FoldGroups::Column(column),
            Grouping::Blocks => FoldGroups::Blocks,
            Grouping::Samples { .. } => FoldGroups::Samples,
        }
    }
}

/// True if each of `rows` names its contact point and some points repeat.
pub(crate) fn has_repeats(dataset: &Dataset, rows: &[usize]) -> bool {
    let points = all_texts(dataset.table().point_id(), rows);
    points.is_some_and(|points| points.iter().collect::<BTreeSet<_>>().len() < points.len())
}

/// Columns of some rows that a split reads.
pub(crate) struct SplitFields {
    points: Option<Vec<String>>,
    times_s: Option<Vec<f64>>,
    parts: Option<Vec<String>>,
    column: Option<(String, Vec<String>)>,
    /// All columns if the requested column is missing, to suggest another column.
    alternatives: Vec<(String, Vec<String>)>,
    recordings: Option<Vec<String>>,
    sections: Vec<usize>,
    blocks: Option<Blocks>,
}

impl SplitFields {
    /// Columns of `rows` of `dataset` that `kind` needs.
    pub(crate) fn of(dataset: &Dataset, rows: &[usize], kind: &SplitKind) -> SplitFields {
        let table = dataset.table();
        let wanted = match kind {
            SplitKind::ByColumn(by) => Some(by.column.as_str()),
            SplitKind::Folds(folds) => match &folds.by {
                FoldGroups::Column(name) => Some(name.as_str()),
                _ => None,
            },
            _ => None,
        };
        let filled = |name: &str| {
            let cells = table.as_text(name)?;
            // A sample without a value is in no part, because no request can name the empty text.
            let filled = rows
                .iter()
                .map(|&row| cells[row].clone().unwrap_or_default());
            Some((name.to_owned(), filled.collect::<Vec<String>>()))
        };
        let column = wanted.and_then(filled);
        let alternatives = if wanted.is_some() && column.is_none() {
            let columns = table.columns().into_iter();
            columns.filter_map(|column| filled(column.name)).collect()
        } else {
            Vec::new()
        };
        let by_blocks = match kind {
            SplitKind::ByBlock => true,
            SplitKind::Folds(folds) => folds.by == FoldGroups::Blocks,
            _ => false,
        };
        SplitFields {
            points: all_texts(table.point_id(), rows),
            times_s: rows.iter().map(|&row| table.t_s()[row]).collect(),
            parts: all_texts(table.part(), rows),
            column,
            alternatives,
            recordings: recordings::names(dataset, rows),
            sections: recordings::sections(dataset, rows),
            blocks: by_blocks.then(|| Blocks::of(dataset, rows)).flatten(),
        }
    }

    /// Input of a split of `rows` samples.
    pub(crate) fn input(&self, rows: usize) -> SplitInput<'_> {
        SplitInput {
            rows,
            points: self.points.as_deref(),
            times_s: self.times_s.as_deref(),
            parts: self.parts.as_deref(),
            columns: self
                .column
                .iter()
                .chain(&self.alternatives)
                .map(|(name, cells)| (name.as_str(), cells.as_slice()))
                .collect(),
            recordings: self.recordings.as_deref(),
            sections: &self.sections,
            blocks: self.blocks.as_ref().map(|blocks| SplitBlocks {
                names: &blocks.names,
                places: &blocks.places,
                gap: blocks.gap,
            }),
        }
    }

    /// Note on neighbours among `rows` that resemble each other, and on their division by `splits`, which contain indices into `rows`.
    pub(crate) fn neighbours(
        &self,
        dataset: &Dataset,
        rows: &[usize],
        kind: &SplitKind,
        splits: &[&Split],
    ) -> Option<Note> {
        let is_asked = match kind {
            SplitKind::All | SplitKind::ByRecording(_) | SplitKind::LeaveOneRecordingOut => false,
            SplitKind::ByPoint => !has_repeats(dataset, rows),
            SplitKind::Folds(folds) if folds.by == FoldGroups::Points => {
                !has_repeats(dataset, rows)
            }
            _ => true,
        };
        if !is_asked {
            return None;
        }
        let Resemblance::Alike(found) = Resemblance::of(dataset, rows) else {
            return None;
        };
        let division = match (&self.blocks, &self.column) {
            (Some(blocks), _) => Division::Blocks {
                count: blocks.count,
                gap: blocks.gap,
            },
            (None, Some((name, _))) if found.column.as_ref() == Some(name) => {
                Division::Column(name.clone())
            }
            _ => {
                let (mut beside, mut of) = (0, 0);
                for split in splits {
                    beside += beside_learnt(dataset, rows, split);
                    of += split.test.len();
                }
                if (beside as f64) <= SHARE_BESIDE * of as f64 {
                    return None;
                }
                Division::Separated { beside, of }
            }
        };
        Some(Note::Neighbours { found, division })
    }

    /// True if each of `rows` counts as its own contact point: points are not named, the division has no groups, and neighbours do not resemble each
    /// other.
    pub(crate) fn are_independent(
        &self,
        dataset: &Dataset,
        rows: &[usize],
        kind: &SplitKind,
    ) -> bool {
        let is_by_sample = match kind {
            SplitKind::Random | SplitKind::Chronological | SplitKind::Declared => true,
            SplitKind::Folds(folds) => folds.by == FoldGroups::Samples,
            kind => names_parts(kind),
        };
        let is_unnamed = || {
            rows.iter()
                .all(|&row| dataset.table().point_id()[row].is_none())
        };
        is_by_sample
            && is_unnamed()
            && dataset.recordings().is_empty()
            && Resemblance::of(dataset, rows) == Resemblance::Apart
    }

    /// Group of every row of `dataset` for intervals, if the division has groups.
    pub(crate) fn groups_of_rows(
        &self,
        dataset: &Dataset,
        rows: &[usize],
        kind: &SplitKind,
    ) -> Option<Vec<String>> {
        let is_by_point = matches!(kind, SplitKind::ByColumn(_)) && has_repeats(dataset, rows);
        let names = match (&self.blocks, &self.column) {
            (Some(blocks), _) => &blocks.names,
            (None, Some((_, cells))) if !is_by_point && !names_parts(kind) => cells,
            _ => return None,
        };
        Some(of_all_rows(names, rows, dataset.table().rows()))
    }
}

/// Converts the `names` of `rows` to names of all rows of a dataset. Other rows have the empty text.
pub(crate) fn of_all_rows(names: &[String], rows: &[usize], all: usize) -> Vec<String> {
    let mut groups = vec![String::new(); all];
    for (row, name) in rows.iter().zip(names) {
        groups[*row].clone_from(name);
    }
    groups
}

/// True if the column of `kind` contains names of parts, which are not groups.
fn names_parts(kind: &SplitKind) -> bool {
    match kind {
        SplitKind::ByColumn(by) => {
            let mut values = by.parts.keys();
            !by.parts.is_empty() && values.all(|value| Part::from_name(value).is_some())
        }
        _ => false,
    }
}

/// Counts the tested samples of `split` with a neighbour in the training or validation part.
fn beside_learnt(dataset: &Dataset, rows: &[usize], split: &Split) -> usize {
    let mut parts = vec![None; rows.len()];
    for part in Part::ALL {
        split
            .rows(part)
            .iter()
            .for_each(|&row| parts[row] = Some(part));
    }
    let is_learnt = |at: usize| matches!(parts[at], Some(Part::Train | Part::Validation));
    let mut beside = vec![false; rows.len()];
    for [one, other] in crate::neighbours::pairs(dataset, rows) {
        beside[one] |= is_learnt(other);
        beside[other] |= is_learnt(one);
    }
    split.test.iter().filter(|&&row| beside[row]).count()
}

/// Texts of `rows`; `None` if any text is missing.
fn all_texts(column: &[Option<String>], rows: &[usize]) -> Option<Vec<String>> {
    rows.iter().map(|&row| column[row].clone()).collect()
}
