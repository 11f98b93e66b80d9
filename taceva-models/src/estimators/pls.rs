//! Partial least squares: regression on few directions in feature space, each with the greatest covariance with the labels.

mod simpls;

use faer::Mat;
use taceva_core::{ModelError, Progress, TrainingSet};

use self::simpls::Directions;
use crate::estimators::linear::{LinearEstimator, LinearFit, LinearRegressor};
use crate::features::FeatureSpec;
use crate::linalg::{Design, FeatureScale};
use crate::settings::{ModelSettings, SettingError, SettingInfo, number};
use crate::training::choice::{ChannelChoice, Choice, ChosenBy, Errors, least, rmse};
use crate::training::fit::estimator;
use crate::training::info::ModelInfo;
use crate::training::problem::{Problem, Validation, centred, joined, stacked};
use crate::training::trials::{FOLDS, folds, folds_of};

/// Partial least squares: regression on few directions in feature space. The directions are shared by all channels.
///
/// Each channel uses its own number of directions. With 0 directions, the model predicts the mean label. The number has the least squared error on
/// the validation part. Without a validation part, the error comes from left-out training samples. Up to ten groups are left out one by one. More
/// groups are combined in ten folds. Without groups, ten runs of consecutive samples are left out. Single samples are not, because samples close in
/// time are similar.
///
/// # Reference
/// S. de Jong, Chemometr. Intell. Lab. Syst. 18 (1993) 251 (SIMPLS).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Pls {
    scale: FeatureScale,
    components: Option<usize>,
    most: usize,
    refit: bool,
}

const COMPONENTS: SettingInfo = SettingInfo {
    key: "components",
    accepts: "a whole number from 1 to 1000",
    default: "chosen for each channel",
    about: "number of directions",
};
const MOST: SettingInfo = SettingInfo {
    key: "most",
    accepts: "a whole number from 1 to 1000",
    default: "60",
    about: "greatest number of directions to try, if their number is chosen",
};

impl Default for Pls {
    fn default() -> Pls {
        Pls {
            scale: FeatureScale::default(),
            components: None,
            most: 60,
            refit: true,
        }
    }
}

impl Pls {
    /// Entry of partial least squares in the model registry.
    pub const INFO: ModelInfo = ModelInfo {
        name: "pls",
        about: "partial least squares: few directions, each with the greatest covariance with the labels",
        settings: &[FeatureScale::SETTING, COMPONENTS, MOST, SettingInfo::REFIT],
        features: Some(FeatureSpec::DEFAULT),
        make: |settings| Ok(Box::new(Pls::from_settings(settings)?)),
        load: LinearRegressor::load,
    };

    /// Builds the estimator from `settings`.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn from_settings(settings: &ModelSettings) -> Result<Pls, SettingError> {
        settings.check_keys(Pls::INFO.settings)?;
        let default = Pls::default();
        Ok(Pls {
            scale: FeatureScale::from_settings(settings)?,
            components: settings.value(&COMPONENTS, default.components, |text| {
                number(text, 1..=1000).map(Some)
            })?,
            most: settings.value(&MOST, default.most, |text| number(text, 1..=1000))?,
            refit: settings.refit()?,
        })
    }

    /// Mean squared error of each channel over the held-out samples, for each number of directions. Rows descend to 0 directions, so ties choose the
    /// smallest.
    fn choose(
        &self,
        problem: &Problem<'_>,
        directions: &Directions,
        design: &Design<'_>,
        validation: Option<&Validation<'_>>,
        progress: &dyn Progress,
    ) -> Result<(ChosenBy, Option<Errors>), ModelError> {
        match (validation, self.components) {
            (Some(part), fixed) => {
                let by = fixed.map_or(ChosenBy::Validation, |_| ChosenBy::Nobody);
                let squares = squares_on(directions, &design.of(part.features), &part.labels);
                Ok((by, Some(mean(squares, part.labels.nrows()))))
            }
            (None, Some(_)) => Ok((ChosenBy::Nobody, None)),
            (None, None) => {
                let (by, groups) = match problem.groups() {
                    Some(groups) if groups.len() <= FOLDS => (ChosenBy::LeaveOneGroupOut, groups),
                    Some(groups) => (ChosenBy::TenFolds, folds_of(groups)),
                    None => (ChosenBy::TenFolds, folds(problem.centred.nrows())),
                };
                let squares = left_out(problem, design, &groups, directions.count(), progress)?;
                Ok((by, Some(mean(squares, problem.centred.nrows()))))
            }
        }
    }
}

/// Squared errors of each channel, summed over all samples, for each number of directions. Each group is predicted by a fit to the other groups.
fn left_out(
    problem: &Problem<'_>,
    whole: &Design<'_>,
    groups: &[Vec<usize>],
    count: usize,
    progress: &dyn Progress,
) -> Result<Errors, ModelError> {
    let channels = problem.channels();
    let mut total = vec![vec![0.0; channels]; count + 1];
    for group in groups {
        let mut inside = vec![false; problem.centred.nrows()];
        group.iter().for_each(|&row| inside[row] = true);
        let others: Vec<usize> = (0..inside.len()).filter(|&row| !inside[row]).collect();
        let rows = |positions: &[usize]| {
            Mat::from_fn(positions.len(), channels, |row, channel| {
                problem.centred[(positions[row], channel)]
            })
        };
        let features = problem.training.features.select(&others);
        let design = whole.recentred(&features);
        let (shift, targets) = centred(rows(&others));
        let directions = Directions::find(&design, &targets, count, progress)?;
        let held = problem.training.features.select(group);
        let labels = Mat::from_fn(group.len(), channels, |row, channel| {
            problem.centred[(group[row], channel)] - shift[channel]
        });
        let squares = squares_on(&directions, &design.of(&held), &labels);
        for (used, sums) in total.iter_mut().enumerate() {
            // A fit that found fewer directions than requested uses all its directions.
            let own = &squares[directions.count() - used.min(directions.count())];
            sums.iter_mut().zip(own).for_each(|(sum, own)| *sum += own);
        }
    }
    total.reverse();
    Ok(total)
}

/// Squared errors of each channel, summed over the samples of `design`. One row per number of directions, descending to 0.
fn squares_on(directions: &Directions, design: &Design<'_>, labels: &Mat<f64>) -> Errors {
    let scores = design.times(directions.weights());
    let mut residuals = labels.clone();
    let mut squares = vec![squares_of(&residuals)];
    for direction in 0..directions.count() {
        for channel in 0..labels.ncols() {
            let loading = directions.loading(direction, channel);
            residuals
                .col_as_slice_mut(channel)
                .iter_mut()
                .zip(scores.col_as_slice(direction))
                .for_each(|(residual, score)| *residual -= score * loading);
        }
        squares.push(squares_of(&residuals));
    }
    squares.reverse();
    squares
}

fn squares_of(residuals: &Mat<f64>) -> Vec<f64> {
    let square = |channel| -> f64 {
        let residuals = residuals.col_as_slice(channel).iter();
        residuals.map(|value| value * value).sum()
    };
    (0..residuals.ncols()).map(square).collect()
}

fn mean(mut squares: Errors, samples: usize) -> Errors {
    squares
        .iter_mut()
        .flatten()
        .for_each(|square| *square /= samples as f64);
    squares
}

impl LinearEstimator for Pls {
    fn fit_linear(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<LinearFit, ModelError> {
        let problem = Problem::new(*training)?;
        let validation = problem.validation(validation)?;
        let design = Design::new(training.features, self.scale);
        let wanted = self.components.unwrap_or(self.most);
        let directions = Directions::find(&design, &problem.centred, wanted, progress)?;
        let found = directions.count();
        let (by, errors) = self.choose(
            &problem,
            &directions,
            &design,
            validation.as_ref(),
            progress,
        )?;
        let counts: Vec<usize> = (0..problem.channels())
            .map(|channel| match (&errors, self.components) {
                (Some(errors), None) => found - least(errors, channel),
                _ => found,
            })
            .collect();
        let choices = counts.iter().enumerate().map(|(channel, &count)| {
            let error = errors.as_ref().map(|errors| errors[found - count][channel]);
            ChannelChoice {
                value: Some(count as f64),
                rmse: error.and_then(|error| rmse(error, problem.scaling.span()[channel])),
                at_edge: self.components.is_none() && count == self.most,
            }
        });
        let choice = Choice {
            by,
            setting: Some(COMPONENTS.key.into()),
            channels: choices.collect(),
        };
        let refitted = self.refit && validation.is_some();
        let regressor = match validation.filter(|_| self.refit) {
            Some(part) => {
                let features = joined(training.features, part.features);
                let design = design.recentred(&features);
                let (shift, labels) = centred(stacked(&problem.centred, &part.labels));
                let most = counts.iter().copied().max().unwrap_or(0);
                let directions = Directions::find(&design, &labels, most, progress)?;
                let mean: Vec<f64> = problem
                    .mean
                    .iter()
                    .zip(&shift)
                    .map(|(mean, shift)| mean + shift)
                    .collect();
                LinearRegressor::from_scaled(
                    &problem,
                    &design,
                    &directions.solution(&counts),
                    &mean,
                )?
            }
            None => {
                let weights = directions.solution(&counts);
                LinearRegressor::from_scaled(&problem, &design, &weights, &problem.mean)?
            }
        };
        Ok(LinearFit {
            regressor,
            choice,
            scaling: problem.scaling,
            refitted,
        })
    }
}

estimator!(Pls, |_| Pls::INFO.name);
