//! The features, chosen by what they cost on samples of the training part that are left out.

use taceva_models::{FeatureChoice, FeatureSpec, Model, OpenFeatures};

use super::{FitPlan, groups};
use crate::error::StudyError;
use crate::features::{extract, extractor};
use crate::work::Work;

/// One group of so many is left out.
const LEFT_OUT_OF: usize = 3;
/// Groups that neighbouring samples are taken as, where no contact point tells.
const RUNS: usize = 10;

/// The training part in two: positions that are learnt from, and those that are scored with the groups that they are independent by.
struct Parts {
    learnt: Vec<usize>,
    left_out: Vec<usize>,
    groups: Vec<usize>,
}

impl FitPlan<'_> {
    /// Tries features from the plainest on, and takes some; grids finer than the default only where the default was worth its price.
    pub(super) fn choose_features(
        &mut self,
        open: OpenFeatures,
        work: Work<'_>,
    ) -> Result<FeatureChoice, StudyError> {
        let frames = self.dataset.header().frames.as_ref();
        let has_reference = frames.is_some_and(|frames| frames.reference.is_some());
        let candidates = open.candidates(&self.features, self.any_frame(), has_reference);
        let parts = self.parts()?;
        // One that puts nothing aside: a checkpoint is of one kind of features.
        let estimator = self.model.estimator(&self.of_model)?;
        let mut tried: Vec<(FeatureSpec, Vec<f64>)> = Vec::new();
        let count = candidates.len() as u64;
        work.progress.begin("features tried", Some(count));
        for spec in candidates {
            let is_finer = spec.width > self.features.width;
            if is_finer && !FeatureChoice::new(&tried, &parts.groups).may_gain() {
                break;
            }
            let model = self.learn(&*estimator, spec, &parts.learnt, work)?;
            tried.push((spec, self.losses(&model, &parts, work)?));
            work.progress.advance(1);
        }
        work.progress.end();
        let choice = FeatureChoice::new(&tried, &parts.groups);
        if let Some(chosen) = choice.chosen() {
            self.features = chosen.features;
        }
        Ok(choice)
    }

    /// Every third contact point is left out; without points, the last third of the samples.
    fn parts(&self) -> Result<Parts, StudyError> {
        let samples = self.train.len();
        if samples < RUNS * LEFT_OUT_OF {
            return Err(StudyError::Request(format!(
                "{samples} training samples, at least {} are needed to choose features by `auto`",
                RUNS * LEFT_OUT_OF
            )));
        }
        let of_point = |number: u32| number as usize % LEFT_OUT_OF == LEFT_OUT_OF - 1;
        let points = groups(self.dataset, &self.train);
        let points = points.filter(|points| points.iter().any(|&number| of_point(number)));
        let first = samples - samples / LEFT_OUT_OF;
        let (left_out, learnt): (Vec<usize>, Vec<usize>) =
            (0..samples).partition(|&at| match &points {
                Some(points) => of_point(points[at]),
                None => at >= first,
            });
        let run = |at: usize| (at - first) * RUNS / (samples - first);
        let group = |&at: &usize| match &points {
            Some(points) => points[at] as usize,
            None => run(at),
        };
        Ok(Parts {
            groups: left_out.iter().map(group).collect(),
            learnt,
            left_out,
        })
    }

    /// The squared error of each sample that was left out, relative to the variance of the labels, mean over the channels that vary.
    fn losses(&self, model: &Model, parts: &Parts, work: Work<'_>) -> Result<Vec<f64>, StudyError> {
        let rows: Vec<usize> = parts.left_out.iter().map(|&at| self.train[at]).collect();
        let extractor = extractor(self.dataset, model.card().features)?;
        let found = model.predict(&extract(self.dataset, &extractor, &rows, work)?)?;
        let (labels, all) = (self.labels(&rows), self.labels(&self.train));
        let channels = self.channels.len();
        let mut losses = vec![0.0; rows.len()];
        let mut varying = 0.0;
        for channel in 0..channels {
            let own = || all.iter().skip(channel).step_by(channels);
            let mean = own().sum::<f64>() / self.train.len() as f64;
            let squares: f64 = own().map(|label| (label - mean).powi(2)).sum();
            if squares <= 0.0 {
                continue;
            }
            varying += 1.0;
            for (row, loss) in losses.iter_mut().enumerate() {
                let at = row * channels + channel;
                *loss += (found[at] - labels[at]).powi(2) * self.train.len() as f64 / squares;
            }
        }
        losses
            .iter_mut()
            .for_each(|loss| *loss /= f64::max(varying, 1.0));
        Ok(losses)
    }
}
