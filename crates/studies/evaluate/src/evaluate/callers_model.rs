//! Scores predictions of a caller's own model, by the rules of built-in models.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;

use taceva_core::{Channels, Targets, shown};
use taceva_dataset::Dataset;
use taceva_models::{LabelBounds, label_means};

use super::request::{Asked, Evaluated};
use super::scores::{Behind, score};
use crate::assess::FitFacts;
use crate::error::EvaluateError;
use crate::note::{Learning, Note};
use crate::predict::{self, Predictor, Target};
use crate::rows::{DataPart, Divided, Need, chosen_channels, require_samples, usable};
use taceva_results::ModelProvenance;

/// Text in place of the unknown digest and training data of a caller's model.
const UNKNOWN: &str = "unknown";

/// Rows for a caller's own model: rows for the fit, and rows to score.
///
/// [`score`](GivenRows::score) computes the scores of the model's predictions.
#[derive(Debug)]
pub struct GivenRows {
    channels: Channels,
    train: Vec<usize>,
    train_left_out: usize,
    target: Target,
    part: Option<DataPart>,
    learns: bool,
    reads_frames: bool,
    is_unbounded: bool,
}

/// Choice of rows for a caller's own model.
#[derive(Clone, Debug, Default)]
pub struct GivenRequest {
    /// Channels by name; empty for all.
    pub channels: Vec<String>,
    /// True if the caller fits the model on the training part now.
    pub learns: bool,
    /// Split in text form. For a model that was fitted before, the split of its fit; `None` if unknown.
    pub split: Option<String>,
    /// Seed of the split.
    pub seed: u64,
    /// Part to score; `None` for the samples that the model has not seen.
    pub part: Option<DataPart>,
    /// True if the model reads frames.
    pub reads_frames: bool,
    /// True to score predictions without clipping. By default, predictions of a model fitted now are clipped to the bounds of its labels.
    pub is_unbounded: bool,
}

/// Name and settings of a caller's own model.
#[derive(Clone, Debug, Default)]
pub struct GivenModel {
    /// Name of the model, such as `sklearn.linear_model.Ridge`.
    pub name: String,
    /// Settings of the model by name, including settings of its features.
    pub settings: BTreeMap<String, String>,
}

impl GivenRows {
    /// Divides `dataset` by the split of `request`.
    ///
    /// # Errors
    /// [`EvaluateError`] for an unknown channel, an impossible split, or a part without samples.
    pub fn new(dataset: &Dataset, request: &GivenRequest) -> Result<GivenRows, EvaluateError> {
        require_samples(dataset)?;
        let channels = chosen_channels(dataset, &request.channels)?;
        let is_divided = request.learns || request.split.is_some();
        let divided = is_divided
            .then(|| Divided::of(dataset, request.split.as_deref(), request.seed))
            .transpose()?;
        let whole = match &divided {
            Some(divided) if request.learns => divided.rows(DataPart::Train),
            _ => Vec::new(),
        };
        let need = Need {
            frame: request.reads_frames,
            labels: Some(&channels),
        };
        let train = usable(dataset, &whole, need);
        if request.learns && train.is_empty() {
            return Err(EvaluateError::Request(
                "no training sample has labels of all channels: name fewer channels".to_owned(),
            ));
        }
        let target = Target::of(dataset, divided, request.part, request.reads_frames)?;
        Ok(GivenRows {
            train_left_out: whole.len() - train.len(),
            channels,
            train,
            target,
            part: request.part,
            learns: request.learns,
            reads_frames: request.reads_frames,
            is_unbounded: request.is_unbounded,
        })
    }

    /// Channels to predict.
    pub fn channels(&self) -> &Channels {
        &self.channels
    }

    /// Rows for the fit, ascending, each with a label of every channel. Empty for a model that was fitted before.
    pub fn train(&self) -> &[usize] {
        &self.train
    }

    /// Rows to predict, ascending.
    pub fn target(&self) -> &[usize] {
        &self.target.rows
    }

    /// Labels of the rows for the fit.
    ///
    /// # Shapes
    /// `[rows, channels]`, row by row.
    pub fn labels(&self, dataset: &Dataset) -> Vec<f64> {
        let table = dataset.table();
        let positions = self.channels.iter();
        let positions: Vec<_> = positions
            .filter_map(|channel| table.channels().position(channel.name()))
            .collect();
        let labels = self.train.iter().flat_map(|row| {
            let own = positions.iter();
            own.filter_map(|position| table.truth(*position).get(*row))
        });
        labels.collect()
    }

    /// Scores of `predictions` for the rows to predict. Predictions of a model fitted now are clipped to the bounds of its labels, as for built-in
    /// models. The skill of such a model is relative to the mean of its labels. The training data of any other model is unknown, and a note states
    /// this.
    ///
    /// # Shapes
    /// `predictions`: `[rows, channels]`, row by row.
    ///
    /// # Errors
    /// [`EvaluateError::Request`] for a wrong number of values, or a value that is not finite.
    pub fn score(
        self,
        dataset: &Dataset,
        model: GivenModel,
        predictions: Vec<f64>,
        metrics: Vec<String>,
        jobs: NonZeroUsize,
    ) -> Result<Evaluated, EvaluateError> {
        self.check(dataset, &model, &predictions)?;
        let labels = self.labels(dataset);
        let targets = Targets::new(&self.channels, &labels);
        let names = self
            .channels
            .iter()
            .map(|channel| channel.name().to_owned());
        let predictor = Predictor {
            bounds: match self.learns && !self.is_unbounded {
                true => LabelBounds::of_labels(targets),
                false => LabelBounds::unknown(self.channels.len()),
            },
            constants: match self.learns {
                true => names.zip(label_means(targets)).collect(),
                false => BTreeMap::new(),
            },
            reads_frames: self.reads_frames,
            channels: self.channels,
        };
        let predicted = predict::predicted_table(
            dataset,
            predictor,
            &self.target,
            &taceva_core::Column::full(predictions),
        )?;
        let asked = Asked {
            metrics: &metrics,
            part: self.part,
            sensor: None,
            is_independent: false,
        };
        let behind = Behind {
            model: ModelProvenance {
                name: model.name,
                settings: model.settings,
                digest: UNKNOWN.to_owned(),
                fitted_on: match self.learns {
                    true => dataset.digest().to_string(),
                    false => UNKNOWN.to_owned(),
                },
                chosen_by: None,
                origin: Some("given".to_owned()),
            },
            fit: FitFacts::default(),
            notes: notes(
                self.learns,
                self.target.divided.is_some(),
                self.train_left_out,
                self.is_unbounded,
            ),
        };
        score(dataset, asked, behind, &self.target, &predicted, jobs)
    }

    fn check(
        &self,
        dataset: &Dataset,
        model: &GivenModel,
        predictions: &[f64],
    ) -> Result<(), EvaluateError> {
        let (rows, width) = (self.target.rows.len(), self.channels.len());
        if predictions.len() != rows * width {
            return Err(EvaluateError::Request(format!(
                "{} predicted {} numbers, expected {rows} samples × {width} channels",
                model.name,
                predictions.len()
            )));
        }
        let Some(at) = predictions.iter().position(|value| !value.is_finite()) else {
            return Ok(());
        };
        let channel = &self.channels.as_slice()[at % width];
        Err(EvaluateError::Request(format!(
            "{} predicted {} of {channel} for the sample {}: expected finite numbers",
            model.name,
            predictions[at],
            shown(&dataset.table().samples()[self.target.rows[at / width]])
        )))
    }
}

fn notes(learns: bool, is_divided: bool, left_out: usize, is_unbounded: bool) -> Vec<Note> {
    let learning = match (learns, is_divided) {
        (true, _) => Learning::Here,
        (false, true) => Learning::Stated,
        (false, false) => Learning::Unknown,
    };
    [
        Some(Note::CallersModel(learning)),
        Note::left_out("train", left_out),
        is_unbounded.then_some(Note::Unbounded),
    ]
    .into_iter()
    .flatten()
    .collect()
}
