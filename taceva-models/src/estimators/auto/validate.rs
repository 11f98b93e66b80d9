//! Five folds: each is scored once by a model that never saw it.

use taceva_core::{ErrorKind, Features, ModelError, Progress, Regressor, Targets, TrainingSet};

use crate::training::fit::ModelEstimator;

/// Folds of the training part.
pub(super) const FOLDS: usize = 5;

/// The rows of each fold.
#[derive(Debug)]
pub(super) struct Folds {
    rows: Vec<Vec<usize>>,
    /// Whether they are whole groups.
    pub(super) by_group: bool,
}

impl Folds {
    /// Whole groups assigned in turn, where there are as many as folds; else runs of neighbouring samples.
    pub(super) fn new(training: &TrainingSet<'_>, groups: Option<Vec<Vec<usize>>>) -> Folds {
        let groups = groups.filter(|groups| groups.len() >= FOLDS);
        let by_group = groups.is_some();
        let samples = training.features.samples();
        let rows = match groups {
            Some(groups) => {
                let mut folds = vec![Vec::new(); FOLDS];
                for (position, group) in groups.into_iter().enumerate() {
                    folds[position % FOLDS].extend(group);
                }
                folds.iter_mut().for_each(|rows| rows.sort_unstable());
                folds
            }
            None => (0..FOLDS)
                .map(|fold| (fold * samples / FOLDS..(fold + 1) * samples / FOLDS).collect())
                .collect(),
        };
        Folds { rows, by_group }
    }

    /// The error of `estimator` on all folds, relative to the deviation of the labels, mean over the channels that vary; the inner
    /// error says why it cannot be fitted here.
    ///
    /// # Errors
    /// [`ModelError`] if `progress` was cancelled.
    pub(super) fn error(
        &self,
        training: &TrainingSet<'_>,
        estimator: &dyn ModelEstimator,
        progress: &dyn Progress,
    ) -> Result<Result<f64, String>, ModelError> {
        let channels = training.targets.channels.len();
        let mut squares = vec![0.0; channels];
        for fold in 0..FOLDS {
            let choosing = (fold + 1) % FOLDS;
            let learnt = (0..FOLDS).filter(|&other| other != fold && other != choosing);
            let learnt: Vec<usize> = learnt.flat_map(|other| self.rows[other].clone()).collect();
            let parts = [&learnt, &self.rows[choosing], &self.rows[fold]];
            let [learnt, choosing, held] = parts.map(|rows| Rows::of(training, rows));
            let result = estimator
                .fit_model(
                    &learnt.set(training),
                    Some(&choosing.set(training)),
                    progress,
                )
                .and_then(|fit| {
                    let mut found = vec![0.0; held.labels.len()];
                    fit.regressor.predict(&held.features, &mut found)?;
                    Ok(found)
                });
            let found = match result {
                Ok(found) => found,
                Err(error) if error.kind() == ErrorKind::Interrupted => return Err(error),
                Err(error) => return Ok(Err(error.to_string())),
            };
            for (position, (found, label)) in found.iter().zip(&held.labels).enumerate() {
                squares[position % channels] += (found - label).powi(2);
            }
        }
        let shares = (0..channels).filter_map(|channel| {
            let labels = || {
                training
                    .targets
                    .values
                    .iter()
                    .skip(channel)
                    .step_by(channels)
            };
            let mean = labels().sum::<f64>() / labels().count() as f64;
            let spread: f64 = labels().map(|label| (label - mean).powi(2)).sum();
            (spread > 0.0).then(|| (squares[channel] / spread).sqrt())
        });
        let shares: Vec<f64> = shares.collect();
        if shares.is_empty() {
            // Nothing varies: every model is right.
            return Ok(Ok(0.0));
        }
        Ok(Ok(shares.iter().sum::<f64>() / shares.len() as f64))
    }
}

/// Some rows of a training part.
struct Rows {
    features: Features,
    labels: Vec<f64>,
    groups: Option<Vec<u32>>,
}

impl Rows {
    fn of(training: &TrainingSet<'_>, rows: &[usize]) -> Rows {
        let channels = training.targets.channels.len();
        let labels = rows.iter().flat_map(|&row| {
            training.targets.values[row * channels..(row + 1) * channels]
                .iter()
                .copied()
        });
        Rows {
            features: training.features.select(rows),
            labels: labels.collect(),
            groups: training
                .groups
                .map(|groups| rows.iter().map(|&row| groups[row]).collect()),
        }
    }

    fn set<'s>(&'s self, training: &TrainingSet<'s>) -> TrainingSet<'s> {
        TrainingSet::new(
            &self.features,
            Targets::new(training.targets.channels, &self.labels),
        )
        .with_groups(self.groups.as_deref())
    }
}
