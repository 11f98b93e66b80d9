//! Assignment of samples to parts.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

use super::error::SplitError;
use super::fractions::Fractions;
use super::input::SplitInput;
use super::part::Part;
use super::spec::{ColumnSplit, SplitKind, SplitSpec};
use crate::settings::Suggestion;
use taceva_core::random::SplitMix64;
use taceva_core::{by_count, counted};

/// Rows of the recording in each part, in ascending order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Split {
    /// Rows for training.
    pub train: Vec<usize>,
    /// Rows for choosing settings.
    pub validation: Vec<usize>,
    /// Rows for testing.
    pub test: Vec<usize>,
    /// Rows that belong to no part.
    pub left_out: Vec<usize>,
    /// Note for readers of results; `None` for no note.
    pub note: Option<String>,
}

impl Split {
    /// Rows of `part`.
    pub fn rows(&self, part: Part) -> &[usize] {
        match part {
            Part::Train => &self.train,
            Part::Validation => &self.validation,
            Part::Test => &self.test,
        }
    }

    /// Converts a split of the ascending `rows` alone to a split of a recording of `all` rows. Rows of the recording outside `rows` are left out.
    ///
    /// # Panics
    /// If the split contains a position beyond the end of `rows`.
    #[must_use]
    pub fn among(mut self, rows: &[usize], all: usize) -> Split {
        for part in [
            &mut self.train,
            &mut self.validation,
            &mut self.test,
            &mut self.left_out,
        ] {
            part.iter_mut()
                .for_each(|position| *position = rows[*position]);
        }
        let others = (0..all).filter(|row| rows.binary_search(row).is_err());
        self.left_out.extend(others);
        self.left_out.sort_unstable();
        self
    }

    pub(super) fn of(parts: impl IntoIterator<Item = Option<Part>>) -> Split {
        let mut split = Split::default();
        for (row, part) in parts.into_iter().enumerate() {
            match part {
                Some(Part::Train) => split.train.push(row),
                Some(Part::Validation) => split.validation.push(row),
                Some(Part::Test) => split.test.push(row),
                None => split.left_out.push(row),
            }
        }
        split
    }
}

impl SplitSpec {
    /// Assigns every row of `input` to a part. The same seed gives the same parts on every machine.
    ///
    /// ```
    /// use taceva_models::{SplitInput, SplitSpec};
    /// let points: Vec<String> = (0..20).map(|row| format!("p{}", row / 2)).collect();
    /// let input = SplitInput { rows: 20, points: Some(&points), ..SplitInput::default() };
    /// let split = "by-point".parse::<SplitSpec>()?.assign(&input, 7)?;
    /// assert_eq!((split.train.len(), split.validation.len(), split.test.len()), (14, 4, 2));
    /// # Ok::<(), taceva_models::SplitError>(())
    /// ```
    ///
    /// # Errors
    /// [`SplitError`] if `input` lacks the required columns, if the split has several folds, or if an empty training or test part should have
    /// samples. The validation part may be empty if parts are named or there are several sections.
    pub fn assign(&self, input: &SplitInput<'_>, seed: u64) -> Result<Split, SplitError> {
        input.check()?;
        let split = match &self.kind {
            SplitKind::Random => {
                let names: Vec<usize> = (0..input.rows).collect();
                by_cluster(&names, input, self.fractions, seed, "samples")
            }
            SplitKind::Chronological => chronological(input, self.fractions),
            SplitKind::ByPoint => {
                let points = input.points.ok_or(SplitError::NoPoints)?;
                by_cluster(points, input, self.fractions, seed, "points").map(|mut split| {
                    if points.iter().collect::<BTreeSet<_>>().len() == input.rows {
                        split.note = Some(
                            "every sample is its own contact point: by-point equals random".into(),
                        );
                    }
                    split
                })
            }
            SplitKind::ByColumn(column) => by_column(input, column, self.fractions, seed),
            SplitKind::ByRecording(parts) => by_recording(input, parts, self.fractions, seed),
            SplitKind::ByBlock => {
                let blocks = input.blocks.ok_or(SplitError::NoBlocks)?;
                // Recordings share no blocks, so random draws can restart for each.
                by_cluster(blocks.names, input, self.fractions, seed, "blocks").map(|split| {
                    let mut split = input.apart(split);
                    split.note = in_gaps(split.left_out.len(), input.rows, blocks.gap);
                    split
                })
            }
            SplitKind::LeaveOneRecordingOut | SplitKind::Folds(_) => Err(SplitError::ManyFolds {
                split: self.to_string(),
            }),
            SplitKind::Declared => declared(input),
            SplitKind::All => Ok(Split {
                train: (0..input.rows).collect(),
                note: Some("every sample is used for training: none is left for a test".to_owned()),
                ..Split::default()
            }),
        }?;
        let needed = |part| part != Part::Validation;
        match Part::ALL
            .into_iter()
            .find(|&part| needed(part) && split.rows(part).is_empty())
        {
            Some(part) if self.share_of(part) > 0.0 => Err(SplitError::Empty { part }),
            _ => Ok(split),
        }
    }

    /// Requested share of a part, from 0 to 1. If the split or the recording names the part of each sample, no shares are requested. Every share then
    /// counts as 1.
    fn share_of(&self, part: Part) -> f64 {
        if self.kind == SplitKind::All {
            return if part == Part::Train { 1.0 } else { 0.0 };
        }
        let named = match &self.kind {
            SplitKind::Declared => true,
            SplitKind::ByColumn(column) => !column.parts.is_empty(),
            SplitKind::ByRecording(parts) => !parts.is_empty(),
            _ => false,
        };
        if named {
            1.0
        } else {
            self.fractions.shares()[part as usize]
        }
    }
}

/// Consecutive sections of the rows of `input`. The flag of a section is true if a recording begins there.
fn sections<'a>(input: &'a SplitInput<'a>) -> impl Iterator<Item = (Range<usize>, bool)> + 'a {
    let starts = std::iter::once(0).chain(input.sections.iter().copied());
    let ends = input.sections.iter().copied().chain([input.rows]);
    starts.zip(ends).map(|(start, end)| {
        let begins = |names: &[String]| start == 0 || names[start] != names[start - 1];
        (start..end, input.recordings.map_or(start == 0, begins))
    })
}

/// Assigns whole clusters to parts at random. All clusters have equal weight, regardless of their number of rows. With one row per cluster, this
/// assigns single rows at random. Clusters are numbered by their first row, so the result does not depend on names.
///
/// A cluster of several sections is assigned in its first section. Random draws restart with each recording. Each recording is therefore divided as
/// if it were alone.
fn by_cluster<N: Ord>(
    names: &[N],
    input: &SplitInput<'_>,
    fractions: Fractions,
    seed: u64,
    what: &'static str,
) -> Result<Split, SplitError> {
    let mut part_of: BTreeMap<&N, Part> = BTreeMap::new();
    let mut chance = SplitMix64::new(seed);
    for (rows, is_new_recording) in sections(input) {
        if is_new_recording {
            chance = SplitMix64::new(seed);
        }
        let mut seen = BTreeSet::new();
        let own = names[rows].iter();
        let new: Vec<&N> = own
            .filter(|name| !part_of.contains_key(name) && seen.insert(*name))
            .collect();
        let mut order: Vec<usize> = (0..new.len()).collect();
        chance.shuffle(&mut order);
        let ranked = parts_of_section(order.len(), input, fractions, what)?;
        for (cluster, part) in order.into_iter().zip(ranked) {
            part_of.insert(new[cluster], part);
        }
    }
    Ok(Split::of(
        names.iter().map(|name| part_of.get(name).copied()),
    ))
}

/// Part of each of the `total` clusters of a section, training first. A part may be empty if there are several sections.
fn parts_of_section(
    total: usize,
    input: &SplitInput<'_>,
    fractions: Fractions,
    what: &'static str,
) -> Result<Vec<Part>, SplitError> {
    match parts_in_order(total, fractions, what) {
        Err(SplitError::Few { .. }) if !input.sections.is_empty() => {
            Ok(in_order(fractions.counts(total)))
        }
        parts => parts,
    }
}

/// Note that `count` of `all` samples are in no part, with the reason and a remedy.
fn left_out(count: usize, all: usize, reason: &str, remedy: &str) -> String {
    format!(
        "{count} of {} {} left out: {reason}; {remedy}",
        counted(all, "sample"),
        by_count(count, "is", "are")
    )
}

/// Note on `count` of `all` samples that lie in the gaps between blocks; `None` without such samples.
fn in_gaps(count: usize, all: usize, gap: usize) -> Option<String> {
    let reason = format!(
        "{} within {} of a validation or test block, and neighbours resemble each other",
        by_count(count, "it lies", "they lie"),
        counted(gap, "sample")
    );
    let remedy = "--split 'cv:5 by-block' tests every sample";
    (count > 0).then(|| left_out(count, all, &reason, remedy))
}

fn by_recording(
    input: &SplitInput<'_>,
    parts: &BTreeMap<String, Part>,
    fractions: Fractions,
    seed: u64,
) -> Result<Split, SplitError> {
    let recordings = input.recordings.ok_or(SplitError::NoRecordings {
        split: "by-recording",
    })?;
    if parts.is_empty() {
        // A recording is one cluster, even if its samples were added at different times.
        let together = SplitInput {
            sections: &[],
            ..input.clone()
        };
        return by_cluster(recordings, &together, fractions, seed, "recordings");
    }
    if let Some(name) = parts.keys().find(|name| !recordings.contains(name)) {
        let known = recordings
            .iter()
            .map(String::as_str)
            .collect::<BTreeSet<_>>();
        return Err(SplitError::NoRecording {
            name: name.clone(),
            suggestion: Suggestion::of(name, known),
        });
    }
    let mut assigned = Split::of(recordings.iter().map(|name| parts.get(name).copied()));
    let count = assigned.left_out.len();
    if count > 0 {
        let reason = format!(
            "{} recording is assigned to no part",
            by_count(count, "its", "their")
        );
        let remedy = "name a part for every recording in --split";
        assigned.note = Some(left_out(count, input.rows, &reason, remedy));
    }
    Ok(assigned)
}

/// List of `total` parts: training first, then validation, then test. Each part with a share has at least one cluster.
fn parts_in_order(
    total: usize,
    fractions: Fractions,
    what: &'static str,
) -> Result<Vec<Part>, SplitError> {
    let mut counts = fractions.counts(total);
    for part in 0..counts.len() {
        if fractions.shares()[part] > 0.0 && counts[part] == 0 {
            let largest = (0..counts.len())
                .rev()
                .max_by_key(|&other| counts[other])
                .filter(|&other| counts[other] > 1);
            let largest = largest.ok_or(SplitError::Few { what, found: total })?;
            counts[largest] -= 1;
            counts[part] += 1;
        }
    }
    Ok(in_order(counts))
}

/// Repeats each part by its number in `counts`: training first, then validation, then test.
fn in_order(counts: [usize; 3]) -> Vec<Part> {
    let counted = Part::ALL.into_iter().zip(counts);
    counted
        .flat_map(|(part, count)| std::iter::repeat_n(part, count))
        .collect()
}

fn chronological(input: &SplitInput<'_>, fractions: Fractions) -> Result<Split, SplitError> {
    let times = input.times_s.ok_or(SplitError::NoTimes)?;
    if let Some(row) = times.iter().position(|time| !time.is_finite()) {
        return Err(SplitError::Time { row });
    }
    let mut parts = vec![None; input.rows];
    for (rows, _) in sections(input) {
        let mut order: Vec<usize> = rows.collect();
        // A stable sort keeps the row order of ties; −0 and 0 are equal times.
        order.sort_by(|&a, &b| (times[a] + 0.0).total_cmp(&(times[b] + 0.0)));
        let ranked = parts_of_section(order.len(), input, fractions, "samples")?;
        for (row, part) in order.into_iter().zip(ranked) {
            parts[row] = Some(part);
        }
    }
    Ok(Split::of(parts))
}

fn by_column(
    input: &SplitInput<'_>,
    split: &ColumnSplit,
    fractions: Fractions,
    seed: u64,
) -> Result<Split, SplitError> {
    let name = split.column.as_str();
    let values = *input
        .columns
        .get(name)
        .ok_or_else(|| SplitError::NoColumn {
            name: name.to_owned(),
            suggestion: Suggestion::of(name, input.columns.keys().copied()),
        })?;
    if split.parts.is_empty() {
        return by_cluster(values, input, fractions, seed, "values");
    }
    if let Some(value) = split.parts.keys().find(|value| !values.contains(value)) {
        return Err(SplitError::NoValue {
            column: name.to_owned(),
            value: value.clone(),
            suggestion: Suggestion::of(
                value,
                values.iter().map(String::as_str).collect::<BTreeSet<_>>(),
            ),
        });
    }
    let mut assigned = Split::of(values.iter().map(|value| split.parts.get(value).copied()));
    let count = assigned.left_out.len();
    if count > 0 {
        let reason = format!(
            "{} `{name}` is assigned to no part",
            by_count(count, "its", "their")
        );
        let remedy = format!("name a part for every value of `{name}` in --split");
        assigned.note = Some(left_out(count, input.rows, &reason, &remedy));
    }
    Ok(assigned)
}

fn declared(input: &SplitInput<'_>) -> Result<Split, SplitError> {
    let names = input.parts.ok_or(SplitError::NoParts)?;
    let parts: Result<Vec<Option<Part>>, SplitError> = names
        .iter()
        .enumerate()
        .map(|(row, name)| match Part::from_name(name) {
            Some(part) => Ok(Some(part)),
            None => Err(SplitError::Part {
                row,
                found: name.clone(),
            }),
        })
        .collect();
    Ok(Split::of(parts?))
}
