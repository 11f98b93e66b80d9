//! Choice of features by their loss on left-out samples of the training part.

use std::collections::BTreeSet;

use taceva_core::{ErrorKind, Features, InputInfo};
use taceva_models::{FeatureChoice, FeatureSpec, Model, ModelEstimator, OpenFeatures};

use super::FitPlan;
use crate::error::EvaluateError;
use crate::features::kinds;
use crate::work::Work;

/// One group in this many is left out.
const LEFT_OUT_OF: usize = 3;
/// Minimum number of left-out contact points for an estimate of the spread. With fewer points, neighbouring samples form groups.
const POINTS_LEAST: usize = 3;
/// Number of groups of neighbouring samples if no contact point is known.
const RUNS: usize = 10;

/// Samples of the training part by position: samples for the fit, and left-out samples with their independent groups.
struct Parts {
    learnt: Vec<usize>,
    left_out: Vec<usize>,
    groups: Vec<usize>,
}

impl FitPlan<'_> {
    /// Tries features, the simplest first, and chooses one specification. Grids finer than the default are tried only if the default improved the loss.
    ///
    /// Reports features for which no model can be fitted, with the reason. If this is the case for all features, the last reason is the error.
    pub(super) fn choose_features(
        &mut self,
        open: OpenFeatures,
        work: Work<'_>,
    ) -> Result<FeatureChoice, EvaluateError> {
        let header = self.dataset.header();
        let (input, has_reference) = match (kinds(self.dataset), &header.frames, &header.signals) {
            ((_, Some(info)), _, Some(signals)) if self.features.channels.is_some() => {
                (InputInfo::from(info), !signals.spec.rest.is_empty())
            }
            ((Some(info), _), Some(frames), _) => (info.into(), frames.reference.is_some()),
            _ => {
                return Err(EvaluateError::Request(
                    "the model needs frames, and the dataset has none".to_owned(),
                ));
            }
        };
        let candidates = open.candidates(&self.features, input, has_reference);
        let parts = self.parts()?;
        // No checkpoint, because a checkpoint belongs to one kind of features.
        let estimator = self.model.estimator(&self.of_model)?;
        let mut tried: Vec<(FeatureSpec, Vec<f64>)> = Vec::new();
        let (mut failed, mut last) = (Vec::new(), None);
        work.progress
            .begin("features tried", Some(candidates.len() as u64));
        let grid = |spec: &FeatureSpec| (spec.width, spec.height);
        for of_grid in candidates.chunk_by(|left, right| grid(left) == grid(right)) {
            let is_finer = of_grid[0].width > self.features.width;
            if is_finer && !FeatureChoice::new(&tried, &parts.groups).may_gain() {
                break;
            }
            for &spec in of_grid {
                match self.attempt(&*estimator, spec, &parts, work) {
                    Ok(losses) => tried.push((spec, losses)),
                    Err(error) if is_own(&error) => {
                        failed.push((spec, error.to_string()));
                        last = Some(error);
                    }
                    Err(error) => return Err(error),
                }
                work.progress.advance(1);
            }
        }
        work.progress.end();
        let choice = FeatureChoice::new(&tried, &parts.groups).with_failed(failed);
        match (choice.chosen(), last) {
            (Some(chosen), _) => self.features = chosen.features,
            (None, Some(error)) => return Err(error),
            (None, None) => {}
        }
        Ok(choice)
    }

    /// Loss of each left-out sample, for a model on the features that `spec` describes.
    fn attempt(
        &self,
        estimator: &dyn ModelEstimator,
        spec: FeatureSpec,
        parts: &Parts,
        work: Work<'_>,
    ) -> Result<Vec<f64>, EvaluateError> {
        let seen = self.see(spec, work)?;
        let left_out = seen.features.select(&parts.left_out);
        let model = self.learn(estimator, seen, None, &parts.learnt, work)?;
        self.losses(&model, &left_out, parts)
    }

    /// Leaves out every third contact point or group. If too few points or groups are known, leaves out the last third of the samples.
    fn parts(&self) -> Result<Parts, EvaluateError> {
        let samples = self.train.len();
        if samples < RUNS * LEFT_OUT_OF {
            return Err(EvaluateError::Request(format!(
                "{samples} training samples: `auto` needs at least {} to choose features",
                RUNS * LEFT_OUT_OF
            )));
        }
        let is_left_out = |number: u32| number as usize % LEFT_OUT_OF == LEFT_OUT_OF - 1;
        let points = self.groups_of(&self.train).filter(|points| {
            let left_out = points.iter().filter(|number| is_left_out(**number));
            left_out.collect::<BTreeSet<_>>().len() >= POINTS_LEAST
        });
        let first = samples - samples / LEFT_OUT_OF;
        let (left_out, learnt): (Vec<usize>, Vec<usize>) =
            (0..samples).partition(|&at| match &points {
                Some(points) => is_left_out(points[at]),
                None => at >= first,
            });
        let group = |&at: &usize| match &points {
            Some(points) => points[at] as usize,
            None => (at - first) * RUNS / (samples - first),
        };
        Ok(Parts {
            groups: left_out.iter().map(group).collect(),
            learnt,
            left_out,
        })
    }

    /// Loss of `model` on each left-out sample.
    fn losses(
        &self,
        model: &Model,
        left_out: &Features,
        parts: &Parts,
    ) -> Result<Vec<f64>, EvaluateError> {
        let found = model.predict(left_out)?;
        let rows: Vec<usize> = parts.left_out.iter().map(|&at| self.train[at]).collect();
        let (labels, all) = (self.labels(&rows), self.labels(&self.train));
        Ok(losses(&found, &labels, &all, self.channels.len()))
    }
}

/// Squared error of each sample relative to the variance of `all` labels, averaged over the varying channels.
///
/// # Shapes
/// Arguments are `[samples, channels]`. Returns `[samples]`.
fn losses(found: &[f64], labels: &[f64], all: &[f64], channels: usize) -> Vec<f64> {
    let mut losses = vec![0.0; labels.len() / channels];
    let mut varying = 0.0_f64;
    for channel in 0..channels {
        let own = || all.iter().skip(channel).step_by(channels).copied();
        let least = own().fold(f64::INFINITY, f64::min);
        // The variance cannot show this: the rounded mean of equal numbers may differ from them.
        if own().all(|label| label <= least) {
            continue;
        }
        let count = own().count() as f64;
        let mean = own().sum::<f64>() / count;
        let squares: f64 = own().map(|label| (label - mean).powi(2)).sum();
        varying += 1.0;
        for (sample, loss) in losses.iter_mut().enumerate() {
            let at = sample * channels + channel;
            *loss += (found[at] - labels[at]).powi(2) * count / squares;
        }
    }
    let varying = varying.max(1.0);
    losses.iter_mut().for_each(|loss| *loss /= varying);
    losses
}

/// True if the tried features caused the error, as opposed to the recording or a cancellation.
fn is_own(error: &EvaluateError) -> bool {
    match error {
        EvaluateError::Model(error) => error.kind() != ErrorKind::Interrupted,
        EvaluateError::Features(_) => true,
        _ => false,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_channel_whose_labels_are_all_the_same_takes_no_part() {
        // The rounded mean of 102 values of 0.1 is not 0.1.
        let all: Vec<f64> = (0..102).flat_map(|row| [f64::from(row % 2), 0.1]).collect();
        let labels = [0.0, 0.1, 1.0, 0.1];
        let found = [0.5, 0.1 + 1e-14, 1.0, 0.1];
        assert_eq!(losses(&found, &labels, &all, 2), [1.0, 0.0]);
        let nothing = losses(&[0.1], &[0.1], &[0.1; 7], 1);
        assert_eq!(nothing, [0.0]);
    }
}
