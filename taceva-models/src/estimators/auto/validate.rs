//! Cross-validation on five folds. Each fold is predicted by a model that was fitted to other folds.

use std::collections::BTreeMap;

use taceva_core::{ErrorKind, Features, ModelError, Progress, Regressor, Targets, TrainingSet};

use crate::training::card::FOLDS;
use crate::training::fit::ModelEstimator;

/// Minimum number of groups per fold. With fewer groups, a loss is computed for each run of consecutive samples.
const GROUPS_LEAST: usize = 3;
/// Number of runs of neighbouring samples in a fold with too few groups. Each run is one unit.
const RUNS: usize = 10;

/// Rows of each fold, and their independent units: groups or runs of neighbouring samples.
#[derive(Debug)]
pub(super) struct Folds {
    rows: Vec<Vec<usize>>,
    /// Unit number of each row, `[folds][rows]`. Each fold numbers its units from 0.
    units: Vec<Vec<usize>>,
    /// Variance of the labels of each channel over the training part, by which squared errors are divided. `None` if all labels are equal.
    variances: Vec<Option<f64>>,
    /// True if a group is never divided between folds.
    pub(super) by_group: bool,
}

impl Folds {
    /// Deals whole groups to the folds in turn if there are at least as many groups as folds. Otherwise, each fold is one run of consecutive samples.
    pub(super) fn new(training: &TrainingSet<'_>, groups: Option<Vec<Vec<usize>>>) -> Folds {
        let groups = groups.filter(|groups| groups.len() >= FOLDS);
        let by_group = groups.is_some();
        let samples = training.features.samples();
        let mut of_group = BTreeMap::new();
        let rows: Vec<Vec<usize>> = match groups {
            Some(groups) => {
                let mut folds = vec![Vec::new(); FOLDS];
                for (position, group) in groups.into_iter().enumerate() {
                    of_group.extend(group.iter().map(|&row| (row, position / FOLDS)));
                    folds[position % FOLDS].extend(group);
                }
                folds.iter_mut().for_each(|rows| rows.sort_unstable());
                folds
            }
            None => (0..FOLDS)
                .map(|fold| (fold * samples / FOLDS..(fold + 1) * samples / FOLDS).collect())
                .collect(),
        };
        let units = rows.iter().map(|rows| units(rows, &of_group)).collect();
        let channels = 0..training.targets.channels.len();
        Folds {
            rows,
            units,
            variances: channels
                .map(|channel| variance(training.targets, channel))
                .collect(),
            by_group,
        }
    }

    /// Loss of each unit of a fold. The model learns from three other folds and chooses settings on the fourth, next fold. A loss is the squared
    /// error divided by the label variance, averaged over samples and varying channels. The inner `Err` says why the model cannot be fitted.
    ///
    /// # Errors
    /// [`ModelError`] if `progress` was cancelled.
    pub(super) fn losses(
        &self,
        fold: usize,
        training: &TrainingSet<'_>,
        estimator: &dyn ModelEstimator,
        progress: &dyn Progress,
    ) -> Result<Result<Vec<f64>, String>, ModelError> {
        let choosing = (fold + 1) % FOLDS;
        let learnt = (0..FOLDS).filter(|&other| other != fold && other != choosing);
        let learnt: Vec<usize> = learnt.flat_map(|other| self.rows[other].clone()).collect();
        let parts = [&learnt, &self.rows[choosing], &self.rows[fold]];
        let [learnt, choosing, held] = parts.map(|rows| Rows::of(training, rows));
        let fit = estimator.fit_model(
            &learnt.set(training),
            Some(&choosing.set(training)),
            progress,
        );
        let found = fit.and_then(|fit| {
            let mut found = vec![0.0; held.labels.len()];
            fit.regressor.predict(&held.features, &mut found)?;
            Ok(found)
        });
        match found {
            Ok(found) => Ok(Ok(self.by_unit(fold, &found, &held.labels))),
            Err(error) if error.kind() == ErrorKind::Interrupted => Err(error),
            Err(error) => Ok(Err(error.to_string())),
        }
    }

    fn by_unit(&self, fold: usize, found: &[f64], labels: &[f64]) -> Vec<f64> {
        let units = &self.units[fold];
        let channels = self.variances.len();
        let varying = self.variances.iter().flatten().count().max(1) as f64;
        let count = units.iter().max().map_or(0, |last| last + 1);
        let mut sums = vec![(0.0, 0.0_f64); count];
        for (row, &unit) in units.iter().enumerate() {
            let own = row * channels..(row + 1) * channels;
            let pairs = found[own.clone()].iter().zip(&labels[own]);
            let losses = pairs
                .zip(&self.variances)
                .filter_map(|(pair, variance)| Some((pair.0 - pair.1).powi(2) / (*variance)?));
            sums[unit].0 += losses.sum::<f64>() / varying;
            sums[unit].1 += 1.0;
        }
        sums.into_iter()
            .map(|(sum, count)| sum / count.max(1.0))
            .collect()
    }
}

/// Unit number of each of `rows`: the number of its group, or of its run of consecutive rows if the fold has too few groups.
fn units(rows: &[usize], of_group: &BTreeMap<usize, usize>) -> Vec<usize> {
    let groups: Option<Vec<usize>> = rows.iter().map(|row| of_group.get(row).copied()).collect();
    let are_enough = |groups: &Vec<usize>| {
        groups
            .iter()
            .max()
            .is_some_and(|last| last + 1 >= GROUPS_LEAST)
    };
    groups.filter(are_enough).unwrap_or_else(|| {
        let runs = RUNS.min(rows.len());
        (0..rows.len()).map(|at| at * runs / rows.len()).collect()
    })
}

/// Variance of a channel's labels; `None` if all labels are equal. Compares the labels, because the rounded mean of equal labels may differ from
/// them.
fn variance(targets: Targets<'_>, channel: usize) -> Option<f64> {
    let channels = targets.channels.len();
    let labels = || {
        targets
            .values
            .iter()
            .skip(channel)
            .step_by(channels)
            .copied()
    };
    let least = labels().fold(f64::INFINITY, f64::min);
    if labels().all(|label| label <= least) {
        return None;
    }
    let count = labels().count() as f64;
    let mean = labels().sum::<f64>() / count;
    Some(labels().map(|label| (label - mean).powi(2)).sum::<f64>() / count)
}

/// A subset of rows of a training part.
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
