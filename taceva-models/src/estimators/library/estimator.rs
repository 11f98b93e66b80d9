//! Adapter from library estimators to [`ModelEstimator`]. Checks, scaling and choice of settings are the same as for models of this crate.

use faer::Mat;
use rayon::prelude::*;
use taceva_core::{ErrorKind, ModelError, Progress, Regressor, TrainingSet};

use super::fit::fit;
use super::{LibraryLearner, LibraryRegressor};
use crate::training::choice::Errors;
use crate::training::fit::{ModelEstimator, ModelFit, estimator};
use crate::training::output::OutputScale;
use crate::training::problem::Problem;
use crate::training::regressor::ModelRegressor;
use crate::training::trials::{Round, Trials, rows_of};

/// An estimator of a library with its settings.
pub(crate) struct LibraryEstimator {
    learner: Box<dyn LibraryLearner>,
}

impl LibraryEstimator {
    /// Squared error of each channel, summed over the held-out samples, for each set of values in `tried`. Infinite if the fit fails.
    fn squares(
        &self,
        trials: &Trials<'_>,
        round: &Round,
        tried: &[Vec<f64>],
        progress: &dyn Progress,
    ) -> Result<Errors, ModelError> {
        let features = trials.features.select(&round.learnt);
        let labels = rows_of(&trials.labels, &round.learnt);
        let held = trials.features.select(&round.held);
        let truth = rows_of(&trials.labels, &round.held);
        let one = |values: &Vec<f64>| {
            let found = fit(&*self.learner, &features, &labels, values, progress)
                .and_then(|fitted| fitted.predict(&held));
            match found {
                Ok(found) => Ok(summed(&found, &truth)),
                Err(error) if error.kind() == ErrorKind::Interrupted => Err(error),
                Err(_) => Ok(vec![f64::INFINITY; truth.ncols()]),
            }
        };
        tried.par_iter().map(one).collect()
    }
}

/// Squared error of each channel, summed over samples.
fn summed(found: &Mat<f64>, truth: &Mat<f64>) -> Vec<f64> {
    let of = |channel: usize| {
        let pairs = found.col_as_slice(channel).iter();
        let pairs = pairs.zip(truth.col_as_slice(channel));
        pairs.map(|(found, label)| (found - label).powi(2)).sum()
    };
    (0..truth.ncols()).map(of).collect()
}

impl ModelEstimator for LibraryEstimator {
    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let problem = Problem::new(*training)?;
        let held = problem.validation(validation)?;
        self.learner.check(training)?;
        let (setting, candidates) = self.learner.candidates().unwrap_or_default();
        let has_setting = !candidates.is_empty();
        let channels = problem.channels();
        let tried: Vec<Vec<f64>> = match has_setting {
            true => candidates
                .iter()
                .map(|&value| vec![value; channels])
                .collect(),
            false => vec![Vec::new()],
        };
        let trials = Trials::new(&problem, held.as_ref(), candidates.len() > 1);
        let errors = trials.errors(progress, |round| {
            self.squares(&trials, round, &tried, progress)
        })?;
        let (chosen, mut choice) = trials.choose(&problem, setting, &candidates, errors.as_ref());
        choice.setting = choice.setting.filter(|_| has_setting);
        let values: Vec<f64> = chosen
            .iter()
            .filter_map(|&candidate| candidates.get(candidate).copied())
            .collect();
        let refit = self.learner.settings().refit;
        let rows = trials.learnt(refit);
        let features = trials.features.select(&rows);
        let labels = match (self.learner.is_classifier(), validation) {
            (false, _) => rows_of(&trials.labels, &rows),
            (true, held) => rows_of(&as_given(training, held), &rows),
        };
        let fitted = fit(&*self.learner, &features, &labels, &values, progress)?;
        let scale = match self.learner.is_classifier() {
            true => OutputScale {
                offset: vec![0.0; channels],
                span: vec![1.0; channels],
            },
            false => OutputScale::of(&problem),
        };
        let shape = training.features.shape();
        let card = self.learner.model().card();
        let regressor = LibraryRegressor::new(
            card,
            training.targets.channels.clone(),
            shape,
            scale,
            fitted,
        );
        // Rejects a model that cannot predict its own training samples.
        let mut known = vec![0.0; features.samples() * channels];
        regressor.predict(&features, &mut known)?;
        let refitted = refit && trials.has_validation();
        Ok(ModelFit {
            regressor: ModelRegressor::new(regressor),
            choice,
            refitted,
            scaling: problem.scaling.clone(),
        })
    }
}

/// Labels of the training part and then of `held`, in the units of the channels, one row per sample.
fn as_given(training: &TrainingSet<'_>, held: Option<&TrainingSet<'_>>) -> Mat<f64> {
    let channels = training.targets.channels.len();
    let values = held.map_or(&[][..], |held| held.targets.values);
    let values = [training.targets.values, values].concat();
    Mat::from_fn(values.len() / channels, channels, |row, channel| {
        values[row * channels + channel]
    })
}

estimator!(LibraryEstimator, |own| own.learner.model().info.name);

/// Makes `learner` a [`ModelEstimator`].
pub(crate) fn library_estimator(learner: impl LibraryLearner + 'static) -> Box<dyn ModelEstimator> {
    Box::new(LibraryEstimator {
        learner: Box::new(learner),
    })
}
