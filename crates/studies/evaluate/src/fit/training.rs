//! Fit of a model on features of frames or signals.

use std::collections::BTreeMap;

use taceva_core::{Features, FrameInfo, InputInfo, PixelFormat, Targets, TrainingSet};
use taceva_dataset::{Dataset, Source};
use taceva_models::{
    CloserFeatures, FeatureSpec, FitInput, Model, ModelEstimator, Provenance, SplitCard,
};

use super::{FitPlan, Fitted};
use crate::error::EvaluateError;
use crate::features::{blank, extract_as, extractor, kinds};
use crate::note::Note;
use crate::recordings;
use crate::task_view::task_card;
use crate::work::Work;

/// Features of the training part, followed by those of the validation part, with their specification and input.
pub(super) struct Seen {
    spec: FeatureSpec,
    pub(super) features: Features,
    input: InputInfo,
}

impl FitPlan<'_> {
    /// Computes the features and fits the model.
    ///
    /// # Errors
    /// [`EvaluateError`] if the dataset cannot be read, or the model cannot be fitted.
    pub fn run(mut self, work: Work<'_>) -> Result<Fitted, EvaluateError> {
        let choice = match self.open {
            Some(open) => Some(self.choose_features(open, work)?),
            None => None,
        };
        let whole: Vec<usize> = (0..self.train.len()).collect();
        let seen = self.see(self.features, work)?;
        let closer = self.closer.map(|spec| self.see(spec, work)).transpose()?;
        let learnt = self.learn(&*self.estimator, seen, closer, &whole, work)?;
        let model = match choice {
            Some(choice) => learnt.with_features_chosen(choice),
            None => learnt,
        };
        let frames_decoded = self.frames_to_decode();
        let manifest = self.divided.manifest(self.dataset.table())?;
        Ok(Fitted {
            model,
            manifest,
            divided: self.divided,
            frames_decoded,
            left_out: self.left_out,
        })
    }

    /// Features that `spec` describes, of the frames or signals of the training part, followed by those of the validation part.
    pub(super) fn see(&self, spec: FeatureSpec, work: Work<'_>) -> Result<Seen, EvaluateError> {
        // Always both parts, because stored features are found by their rows.
        let rows = [&self.train[..], &self.validation].concat();
        if !self.model.reads_features() {
            return Ok(Seen {
                spec,
                features: blank(spec.shape(), rows.len())?,
                input: self.any_input(spec),
            });
        }
        let (frame, signals) = kinds(self.dataset);
        let input = match spec.channels {
            None => frame.map(InputInfo::from),
            Some(_) => signals.map(InputInfo::from),
        };
        let of = |recording: &Dataset| extractor(recording, spec);
        let task = self.dataset.labelled_by();
        let clusters = task.map(|task| task.cluster.as_str());
        Ok(Seen {
            spec,
            features: extract_as(self.dataset, &spec, clusters, of, &rows, work)?,
            input: input.unwrap_or_else(|| self.any_input(spec)),
        })
    }

    /// Fits a model on the features `seen` and on the finer features. Reads the samples at `positions` of the training part, and the validation part.
    pub(super) fn learn(
        &self,
        estimator: &dyn ModelEstimator,
        seen: Seen,
        closer: Option<Seen>,
        positions: &[usize],
        work: Work<'_>,
    ) -> Result<Model, EvaluateError> {
        let train: Vec<usize> = positions.iter().map(|&at| self.train[at]).collect();
        let parts = |seen: Seen| {
            let held: Vec<usize> = (self.train.len()..seen.features.samples()).collect();
            let parts = (seen.features.select(positions), seen.features.select(&held));
            (seen.spec, seen.input, parts)
        };
        let (spec, input, (train_features, held_features)) = parts(seen);
        let closer = closer.map(parts);
        let (train_labels, held_labels) = (self.labels(&train), self.labels(&self.validation));
        let groups = self.groups_of(&train);
        let set = |features, values, groups| {
            TrainingSet::new(features, Targets::new(&self.channels, values)).with_groups(groups)
        };
        let whole = FitInput {
            estimator,
            settings: &self.settings,
            features: spec,
            input,
            training: set(&train_features, &train_labels, groups.as_deref()),
            validation: (!self.validation.is_empty())
                .then(|| set(&held_features, &held_labels, None)),
            provenance: self.provenance(),
        };
        Ok(match &closer {
            None => Model::fit(whole, work.progress)?,
            Some((spec, _, (training, held))) => {
                let closer = CloserFeatures {
                    spec: *spec,
                    training,
                    validation: (!self.validation.is_empty()).then_some(held),
                };
                Model::fit_closer(whole, closer, work.progress)?
            }
        })
    }

    /// Number of the group, or of the contact point, of each row; `None` if a row has no group and no contact point.
    pub(super) fn groups_of(&self, rows: &[usize]) -> Option<Vec<u32>> {
        let points = self.dataset.table().point_id();
        let name = |row: usize| match &self.groups {
            Some(groups) => Some(groups[row].as_str()),
            None => points[row].as_deref(),
        };
        let mut numbers: BTreeMap<&str, u32> = BTreeMap::new();
        rows.iter()
            .map(|&row| {
                let name = name(row)?;
                let next = u32::try_from(numbers.len()).ok()?;
                Some(*numbers.entry(name).or_insert(next))
            })
            .collect()
    }

    pub(super) fn labels(&self, rows: &[usize]) -> Vec<f64> {
        let table = self.dataset.table();
        let positions: Vec<usize> = self
            .channels
            .iter()
            .filter_map(|channel| table.channels().position(channel.name()))
            .collect();
        let value = |row: usize, position: usize| {
            table
                .truth(position)
                .get(row)
                .expect("rows without a label were left out")
        };
        rows.iter()
            .flat_map(|&row| positions.iter().map(move |&position| (row, position)))
            .map(|(row, position)| value(row, position))
            .collect()
    }

    /// Input that the model card states for a model that reads no input.
    fn any_input(&self, spec: FeatureSpec) -> InputInfo {
        let unseen = FrameInfo {
            width: 1,
            height: 1,
            format: PixelFormat::Gray8,
        };
        match kinds(self.dataset) {
            (_, Some(signals)) if spec.channels.is_some() => signals.into(),
            (frame, _) => frame.unwrap_or(unseen).into(),
        }
    }

    fn provenance(&self) -> Provenance {
        let source = match self.dataset.header().source {
            Source::Recorded => taceva_models::Source::Recorded,
            Source::Simulated => taceva_models::Source::Simulated,
            Source::Synthetic => taceva_models::Source::Synthetic,
        };
        Provenance {
            data: Some(self.dataset.digest().to_string()),
            recordings: recordings::provenance(self.dataset)
                .into_iter()
                .map(|own| own.digest)
                .collect(),
            view: self.dataset.view(),
            source,
            split: Some(SplitCard {
                split: self.divided.spec.to_string(),
                seed: self.divided.seed,
            }),
            notes: {
                let neighbours = self.divided.neighbours.iter().map(Note::to_string);
                neighbours.chain(self.divided.split.note.clone()).collect()
            },
            validation: None,
            task: self.dataset.labelled_by().map(task_card),
        }
    }
}
