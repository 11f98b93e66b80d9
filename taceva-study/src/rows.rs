//! A dataset as a split sees it, and the rows that can take part.

use std::collections::BTreeMap;

use taceva_core::Channels;
use taceva_dataset::{Dataset, Table};
use taceva_models::{Part as SplitPart, Split, SplitInput, SplitKind, SplitManifest, SplitSpec};

use crate::error::StudyError;

/// The part of a dataset that is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    /// What a model was fitted on.
    Train,
    /// What its settings were chosen on.
    Validation,
    /// What it has not seen.
    Test,
    /// Every sample.
    All,
}

impl Part {
    /// The word used in results.
    pub const fn name(self) -> &'static str {
        match self {
            Part::Train => "train",
            Part::Validation => "validation",
            Part::Test => "test",
            Part::All => "all",
        }
    }
}

/// A dataset divided, with the record of it.
#[derive(Clone, Debug)]
pub struct Divided {
    /// How.
    pub spec: SplitSpec,
    /// The seed.
    pub seed: u64,
    /// Which rows went where.
    pub split: Split,
}

impl Divided {
    /// Divides `table` as `text` says, or by point where points have repeats, else at random.
    ///
    /// # Errors
    /// [`StudyError::Split`] if the text means no split, or the table lacks what it needs.
    pub fn new(table: &Table, text: Option<&str>, seed: u64) -> Result<Divided, StudyError> {
        let points = all_texts(table.point_id());
        let spec = match text {
            Some(text) => text.parse::<SplitSpec>()?,
            None => default_spec(points.as_deref()),
        };
        let times: Option<Vec<f64>> = table.t_s().iter().copied().collect();
        let parts = all_texts(table.part());
        let column = match &spec.kind {
            SplitKind::ByColumn(by) => table
                .as_text(&by.column)
                .map(|cells| (by.column.as_str(), cells)),
            _ => None,
        };
        // A sample without the value is in no part: nobody can name the empty text.
        let filled = column.map(|(name, cells)| {
            (
                name,
                cells
                    .into_iter()
                    .map(Option::unwrap_or_default)
                    .collect::<Vec<String>>(),
            )
        });
        let columns: BTreeMap<&str, &[String]> = filled
            .iter()
            .map(|(name, cells)| (*name, cells.as_slice()))
            .collect();
        let input = SplitInput {
            rows: table.rows(),
            points: points.as_deref(),
            times_s: times.as_deref(),
            parts: parts.as_deref(),
            columns,
        };
        let split = spec.assign(&input, seed)?;
        Ok(Divided { spec, seed, split })
    }

    /// The rows of a part, ascending.
    pub fn rows(&self, part: Part) -> Vec<usize> {
        match part {
            Part::Train => self.split.rows(SplitPart::Train).to_vec(),
            Part::Validation => self.split.rows(SplitPart::Validation).to_vec(),
            Part::Test => self.split.rows(SplitPart::Test).to_vec(),
            Part::All => {
                let split = &self.split;
                let mut rows = [
                    &split.train[..],
                    &split.validation,
                    &split.test,
                    &split.left_out,
                ]
                .concat();
                rows.sort_unstable();
                rows
            }
        }
    }

    /// The parts by the names of their samples.
    ///
    /// # Errors
    /// [`StudyError::Split`] if `table` is not the one that was divided.
    pub fn manifest(&self, table: &Table) -> Result<SplitManifest, StudyError> {
        Ok(SplitManifest::new(
            &self.spec,
            self.seed,
            &self.split,
            table.samples(),
        )?)
    }

    /// Samples a part, for provenance.
    pub(crate) fn counts(&self) -> BTreeMap<String, usize> {
        let parts = [Part::Train, Part::Validation, Part::Test]
            .map(|part| (part.name().to_owned(), self.rows(part).len()));
        let left_out = (!self.split.left_out.is_empty())
            .then(|| ("left_out".to_owned(), self.split.left_out.len()));
        parts.into_iter().chain(left_out).collect()
    }
}

fn default_spec(points: Option<&[String]>) -> SplitSpec {
    let have_repeats = points.is_some_and(|points| {
        let distinct: std::collections::BTreeSet<&String> = points.iter().collect();
        distinct.len() < points.len()
    });
    let kind = if have_repeats {
        SplitKind::ByPoint
    } else {
        SplitKind::Random
    };
    SplitSpec {
        kind,
        fractions: Default::default(),
    }
}

/// The texts, if every row has one.
fn all_texts(column: &[Option<String>]) -> Option<Vec<String>> {
    column.iter().cloned().collect()
}

/// The channels called `names`, or all of the dataset.
///
/// # Errors
/// [`StudyError::Request`] for a name that the dataset has not, or if there is no channel at all.
pub(crate) fn chosen_channels(dataset: &Dataset, names: &[String]) -> Result<Channels, StudyError> {
    let known = dataset.table().channels();
    let chosen = if names.is_empty() {
        known.clone()
    } else {
        let find = |name: &String| {
            known.by_name(name).cloned().ok_or_else(|| {
                let list: Vec<&str> = known.iter().map(|channel| channel.name()).collect();
                StudyError::Request(format!(
                    "`{name}`: no such channel, the dataset has {}",
                    list.join(", ")
                ))
            })
        };
        let list = names.iter().map(find).collect::<Result<Vec<_>, _>>()?;
        Channels::new(list).map_err(|error| StudyError::Request(error.to_string()))?
    };
    if chosen.is_empty() {
        return Err(StudyError::Request(
            "the dataset has no channel: there is nothing to predict".to_owned(),
        ));
    }
    Ok(chosen)
}

/// Of `rows`, those that have a frame where one is needed, and a value of each of `channels` where `labelled`.
pub(crate) fn usable(dataset: &Dataset, rows: &[usize], need: Need<'_>) -> Vec<usize> {
    let table = dataset.table();
    let positions: Vec<usize> = need
        .labels
        .iter()
        .flat_map(|channels| channels.iter())
        .filter_map(|channel| table.channels().position(channel.name()))
        .collect();
    let is_usable = |row: &usize| {
        let framed = !need.frame || table.frames()[*row].is_some();
        framed
            && positions
                .iter()
                .all(|&position| table.truth(position).get(*row).is_some())
    };
    rows.iter().copied().filter(is_usable).collect()
}

/// What a row must have.
pub(crate) struct Need<'a> {
    /// A frame.
    pub(crate) frame: bool,
    /// A label of each of these.
    pub(crate) labels: Option<&'a Channels>,
}
