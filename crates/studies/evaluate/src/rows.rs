//! Division of a dataset into parts, and its usable rows.

use std::collections::BTreeMap;

use taceva_core::{Channel, Channels, Field, shown};
use taceva_dataset::{Dataset, Table};
use taceva_metrics::PLANES;
use taceva_models::{
    Fractions, Model, Part as SplitPart, Split, SplitKind, SplitManifest, SplitSpec,
};

use crate::calibration_rows::{self, PlannedRows};
use crate::error::EvaluateError;
use crate::grouping::{Grouping, SplitFields};
use crate::note::Note;
use crate::recordings::is_fitted_on;

/// Columns of a table of samples that are not channels, in the order of the table.
pub(crate) const BESIDE_CHANNELS: [Field; 10] = [
    Field::Point,
    Field::UnitId,
    Field::Scene,
    Field::DepthStep,
    Field::Repeat,
    Field::Phase,
    Field::Stamp,
    Field::Kind,
    Field::Spacing,
    Field::Intensity,
];

/// Name of the column with distances of frames from the training part, as in the table of live predictions.
pub(crate) const DISTANCE: &str = "distance";

/// A part of a dataset.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DataPart {
    /// Samples for the fit of a model.
    Train,
    /// Samples for choosing settings.
    Validation,
    /// Samples that the model has not seen.
    Test,
    /// Every sample.
    All,
}

impl DataPart {
    /// Name of the part in results.
    pub const fn name(self) -> &'static str {
        match self {
            DataPart::Train => "train",
            DataPart::Validation => "validation",
            DataPart::Test => "test",
            DataPart::All => "all",
        }
    }
}

/// A dataset divided into parts, with the method of the division.
#[derive(Clone, Debug)]
pub struct Divided {
    /// Method of the division.
    pub spec: SplitSpec,
    /// Seed of the division.
    pub seed: u64,
    /// Part of each row.
    pub split: Split,
    /// Note on neighbouring samples, if any.
    pub neighbours: Option<Note>,
    /// Group of every row of the dataset, if confidence intervals are by group. Rows without a group have the empty text.
    pub groups: Option<Vec<String>>,
    /// True if no contact point repeats and neighbours do not resemble each other. Each sample then counts as one contact point.
    pub are_independent: bool,
    /// Tested rows of each fold; empty for a single division.
    pub folds: Vec<Vec<usize>>,
}

impl Divided {
    /// Division of `dataset` for `model`, which was fitted on it, possibly before rows were added. All samples that `model` has seen are in the training and
    /// validation parts. `None` if the model was fitted on another dataset.
    ///
    /// # Errors
    /// [`EvaluateError::Split`] as [`Divided::new`]. [`EvaluateError::Request`] if the plan that divided the dataset is missing, or if `model` was fitted on
    /// only some of the recordings.
    pub fn by_model(dataset: &Dataset, model: &Model) -> Result<Option<Divided>, EvaluateError> {
        let provenance = &model.card().provenance;
        let is_own = is_fitted_on(model, dataset)?;
        let Some(card) = provenance.split.as_ref().filter(|_| is_own) else {
            return Ok(None);
        };
        let is_planned =
            (provenance.notes.iter()).any(|note| note.contains(calibration_rows::NOTE));
        let divided = match (is_planned, PlannedRows::of(dataset)?) {
            (true, None) => {
                return Err(EvaluateError::Request(format!(
                    "{}: the model was fitted on the calibration presses of a run; name the recording in the folder of that run",
                    shown(dataset.path())
                )));
            }
            (true, Some(_)) => Divided::of(dataset, Some(&card.split), card.seed),
            (false, _) => Divided::new(dataset, Some(&card.split), card.seed),
        };
        divided.map(Some)
    }

    /// Divides `dataset` by the split `text`. The default is by point if points repeat, else by groups or blocks of time if neighbours resemble each other,
    /// else at random. Joined recordings are divided independently of each other. Added rows do not change the part of earlier rows.
    ///
    /// # Errors
    /// [`EvaluateError::Split`] if the text is not a split, or the table lacks a column that the split needs.
    pub fn new(dataset: &Dataset, text: Option<&str>, seed: u64) -> Result<Divided, EvaluateError> {
        Divided::within(dataset, &dataset.all_rows(), text, seed)
    }

    /// Divides `dataset` by the split `text`. The default for a recording of a run is its plan, which divides the presses for the fit with the seed of its
    /// scene.
    ///
    /// # Errors
    /// Errors of [`new`](Divided::new). [`EvaluateError::RunFolder`] if the plan of the run cannot be read.
    pub fn of(dataset: &Dataset, text: Option<&str>, seed: u64) -> Result<Divided, EvaluateError> {
        let Some(planned) = PlannedRows::of(dataset)? else {
            return Divided::new(dataset, text, seed);
        };
        let seed = if text.is_none() { planned.seed } else { seed };
        let mut divided = Divided::within(dataset, &planned.rows, text, seed)?;
        let note = &mut divided.split.note;
        *note = Some(match note.take() {
            Some(before) => format!("{}; {before}", calibration_rows::NOTE),
            None => calibration_rows::NOTE.to_owned(),
        });
        Ok(divided)
    }

    /// Divides the ascending `rows` of `dataset`; all other rows are in no part.
    ///
    /// # Errors
    /// Errors of [`new`](Divided::new).
    pub fn within(
        dataset: &Dataset,
        rows: &[usize],
        text: Option<&str>,
        seed: u64,
    ) -> Result<Divided, EvaluateError> {
        let spec = match text {
            Some(text) => text.parse::<SplitSpec>()?,
            None => SplitSpec {
                kind: Grouping::of(dataset, rows).kind(),
                fractions: Fractions::default(),
            },
        };
        Divided::by_spec(dataset, rows, spec, seed)
    }

    /// Divides `rows` of `dataset` by the default split, into parts with the shares `fractions`.
    ///
    /// # Errors
    /// Errors of [`new`](Divided::new).
    pub fn within_default(
        dataset: &Dataset,
        rows: &[usize],
        fractions: Fractions,
        seed: u64,
    ) -> Result<Divided, EvaluateError> {
        let spec = SplitSpec {
            kind: Grouping::of(dataset, rows).kind(),
            fractions,
        };
        Divided::by_spec(dataset, rows, spec, seed)
    }

    fn by_spec(
        dataset: &Dataset,
        rows: &[usize],
        spec: SplitSpec,
        seed: u64,
    ) -> Result<Divided, EvaluateError> {
        let fields = SplitFields::of(dataset, rows, &spec.kind);
        let split = spec.assign(&fields.input(rows.len()), seed)?;
        let neighbours = fields.neighbours(dataset, rows, &spec.kind, &[&split]);
        let groups = fields.groups_of_rows(dataset, rows, &spec.kind);
        let are_independent = fields.are_independent(dataset, rows, &spec.kind);
        let split = match rows.len() < dataset.table().rows() {
            true => split.among(rows, dataset.table().rows()),
            false => split,
        };
        Ok(Divided {
            spec,
            seed,
            split,
            neighbours,
            groups,
            are_independent,
            folds: Vec::new(),
        })
    }

    /// Rows of a part, ascending.
    pub fn rows(&self, part: DataPart) -> Vec<usize> {
        match part {
            DataPart::Train => self.split.rows(SplitPart::Train).to_vec(),
            DataPart::Validation => self.split.rows(SplitPart::Validation).to_vec(),
            DataPart::Test => self.split.rows(SplitPart::Test).to_vec(),
            DataPart::All => {
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

    /// Rejects the split `all`, which leaves no test samples.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] with the alternatives.
    pub fn require_test(&self) -> Result<(), EvaluateError> {
        if self.spec.kind != SplitKind::All {
            return Ok(());
        }
        Err(EvaluateError::Request(
            "split all: the model is fitted on every sample, so no test part is left; evaluate another recording, or score the training samples with --part train"
                .to_owned(),
        ))
    }

    /// Record of the names of the samples in each part, and in each fold.
    ///
    /// # Errors
    /// [`EvaluateError::Split`] if `table` is not the divided table.
    pub fn manifest(&self, table: &Table) -> Result<SplitManifest, EvaluateError> {
        let names = table.samples();
        let named = |rows: &Vec<usize>| rows.iter().map(|&row| names[row].clone()).collect();
        let manifest = SplitManifest::new(&self.spec, self.seed, &self.split, names)?;
        Ok(manifest.with_folds(self.folds.iter().map(named).collect()))
    }

    /// Number of samples by part, for provenance.
    pub fn counts(&self) -> BTreeMap<String, usize> {
        let parts = [DataPart::Train, DataPart::Validation, DataPart::Test]
            .map(|part| (part.name().to_owned(), self.rows(part).len()));
        let left_out = (!self.split.left_out.is_empty())
            .then(|| ("left_out".to_owned(), self.split.left_out.len()));
        parts.into_iter().chain(left_out).collect()
    }
}

/// Rejects a dataset without samples.
///
/// # Errors
/// [`EvaluateError::NoSamples`] for a dataset without samples.
pub fn require_samples(dataset: &Dataset) -> Result<(), EvaluateError> {
    match dataset.table().rows() {
        0 => Err(EvaluateError::NoSamples {
            path: dataset.path().to_owned(),
        }),
        _ => Ok(()),
    }
}

/// Channels with a label in at least one sample with a frame. If there are none, all of `channels`.
pub(crate) fn seen_channels(dataset: &Dataset, channels: &Channels) -> Channels {
    let table = dataset.table();
    let is_seen = |channel: &&Channel| {
        let position = table.channels().position(channel.name());
        let seen = |(row, frame): (usize, &Option<_>)| {
            let truth = position.and_then(|position| table.truth(position).get(row));
            frame.is_some() && truth.is_some()
        };
        table.frames().iter().enumerate().any(seen)
    };
    let seen: Vec<Channel> = channels.iter().filter(is_seen).cloned().collect();
    if seen.is_empty() {
        return channels.clone();
    }
    Channels::new(seen).expect("a subset of distinct channels is distinct")
}

/// Channels with the names `names`; all channels of the dataset if `names` is empty.
///
/// # Errors
/// [`EvaluateError::Request`] for an unknown name, or if the dataset has no channel.
pub(crate) fn chosen_channels(
    dataset: &Dataset,
    names: &[String],
) -> Result<Channels, EvaluateError> {
    let known = dataset.table().channels();
    let chosen = if names.is_empty() {
        known.clone()
    } else {
        let find = |name: &String| {
            known.by_name(name).cloned().ok_or_else(|| {
                let list: Vec<&str> = known.iter().map(|channel| channel.name()).collect();
                EvaluateError::Request(format!(
                    "`{}`: no such channel, the dataset has {}{}",
                    shown(name),
                    list.join(", "),
                    hint(name, &list)
                ))
            })
        };
        let list = names.iter().map(find).collect::<Result<Vec<_>, _>>()?;
        Channels::new(list).map_err(|error| EvaluateError::Request(error.to_string()))?
    };
    if chosen.is_empty() {
        return Err(EvaluateError::Request(
            "the dataset has no channel to predict: import it again with a map that names labels under [columns], such as \
             Fz = { from = \"COLUMN\", unit = \"N\" }"
                .to_owned(),
        ));
    }
    Ok(chosen)
}

/// Suggestion for the unknown channel `name`: the two channels of a plane, such as `Fxy`, or the most similar channel in `known`.
fn hint(name: &str, known: &[&str]) -> String {
    let mut planes = PLANES.into_iter();
    let plane = planes.find(|(plane, of, _)| {
        plane.eq_ignore_ascii_case(name) && of.iter().all(|channel| known.contains(channel))
    });
    match (plane, taceva_core::nearest(name, known.iter().copied())) {
        (Some((plane, [x, y], _)), _) => {
            format!("; {plane} is computed from {x} and {y}: --channels {x},{y}")
        }
        (None, Some(nearest)) => format!("; did you mean `{nearest}`?"),
        (None, None) => String::new(),
    }
}

/// Rows among `rows` that meet `need`.
pub fn usable(dataset: &Dataset, rows: &[usize], need: Need<'_>) -> Vec<usize> {
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

/// Requirements on a row.
pub struct Need<'a> {
    /// True if a frame is required.
    pub frame: bool,
    /// Channels that must each have a label; `None` if no label is required.
    pub labels: Option<&'a Channels>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_plane_and_another_case_of_a_channel_are_understood() {
        let six = ["Px", "Py", "Pz", "Fx", "Fy", "Fz"];
        let plane = "; Fxy is computed from Fx and Fy: --channels Fx,Fy";
        assert_eq!(hint("Fxy", &six), plane);
        assert_eq!(hint("fxy", &six), plane);
        assert_eq!(hint("fz", &six), "; did you mean `Fz`?");
        assert_eq!(hint("temperature", &six), "");
        assert_eq!(hint("Fxy", &["Px", "Fz"]), "");
    }
}
