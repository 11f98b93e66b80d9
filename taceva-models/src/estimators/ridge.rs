//! Ridge regression. One eigendecomposition solves it for all penalties.

mod leave_out;
mod strength;
mod unpenalised;

use faer::Mat;
use taceva_core::{Features, ModelError, Progress, TrainingSet};

use self::leave_out::LeaveOut;
use crate::estimators::linear::{LinearEstimator, LinearFit, LinearRegressor};
use crate::features::FeatureSpec;
use crate::linalg::progress::ReportedStage;
use crate::linalg::{Design, FeatureScale, Spectrum};
use crate::settings::{ModelSettings, SettingError, SettingInfo, number};
use crate::training::choice::{ChannelChoice, Choice, ChosenBy, Errors, least, rmse};
use crate::training::fit::estimator;
use crate::training::info::ModelInfo;
use crate::training::problem::{Problem, Validation, centred, joined, stacked};

/// Ridge regression. For each channel, minimises Σ (y − b − wᵀx)² + λ‖w‖² over samples with features x and label y. The intercept b is not penalised.
///
/// The penalty λ is the strength times the mean eigenvalue of the centred Gram matrix. A strength thus means the same for bright and dark pictures,
/// and for any number of pictures. Each channel chooses one of 41 strengths: 10⁻⁶, 10⁻⁵·⁷⁵ … 10⁴. The chosen strength has the least squared error on
/// the validation part. Without a validation part, each group of training samples is left out in turn, or each single sample if there are no groups.
/// These errors are exact: blocks of the hat matrix replace the refits. Strength 0 is least squares without a penalty, solved separately. It needs
/// more samples than features.
///
/// # Reference
/// A. E. Hoerl, R. W. Kennard, Technometrics 12 (1970) 55; D. M. Allen, Technometrics 16 (1974) 125 (leaving out).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ridge {
    scale: FeatureScale,
    strength: Option<f64>,
    refit: bool,
}

const STRENGTH: SettingInfo = SettingInfo {
    key: "strength",
    accepts: "0 or a number from 1e-12 to 1e12",
    default: "chosen for each channel",
    about: "the penalty on large weights, relative to the mean eigenvalue",
};

impl Default for Ridge {
    fn default() -> Ridge {
        Ridge {
            scale: FeatureScale::default(),
            strength: None,
            refit: true,
        }
    }
}

impl Ridge {
    /// Entry of ridge regression in the model registry.
    pub const INFO: ModelInfo = ModelInfo {
        name: "ridge",
        about: "least squares with a penalty on large weights; fast, and hard to beat on few recordings",
        settings: &[FeatureScale::SETTING, STRENGTH, SettingInfo::REFIT],
        features: Some(FeatureSpec::DEFAULT),
        make: |settings| Ok(Box::new(Ridge::from_settings(settings)?)),
        load: LinearRegressor::load,
    };

    /// Builds the unfitted ridge regression from `settings`.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn from_settings(settings: &ModelSettings) -> Result<Ridge, SettingError> {
        settings.check_keys(Ridge::INFO.settings)?;
        let default = Ridge::default();
        Ok(Ridge {
            scale: FeatureScale::from_settings(settings)?,
            strength: settings.value(&STRENGTH, default.strength, |text| {
                let zero = || number(text, 0.0..=0.0);
                number(text, 1e-12..=1e12).or_else(zero).map(Some)
            })?,
            refit: settings.refit()?,
        })
    }

    /// Ridge regression on unscaled features. Each channel's strength is chosen by error. With `refit`, the final fit includes the validation part.
    pub(crate) fn unscaled(refit: bool) -> Ridge {
        Ridge {
            scale: FeatureScale::None,
            strength: None,
            refit,
        }
    }

    /// Strength of the penalty, equal for all channels, as set by the user. `None` if each channel chooses its own.
    pub fn strength(&self) -> Option<f64> {
        self.strength
    }

    fn candidates(&self) -> Vec<f64> {
        self.strength
            .map_or_else(strength::grid, |strength| vec![strength])
    }

    fn choose(
        &self,
        problem: &Problem<'_>,
        path: &Path<'_, '_, '_>,
        validation: Option<&Validation<'_>>,
        progress: &dyn Progress,
    ) -> Result<(ChosenBy, Option<Errors>), ModelError> {
        match (validation, self.strength) {
            (Some(part), strength) => {
                let _stage = ReportedStage::begin(progress, "error on validation", 1);
                let by = strength.map_or(ChosenBy::Validation, |_| ChosenBy::Nobody);
                return Ok((by, Some(path.errors_on(part))));
            }
            (None, Some(_)) => return Ok((ChosenBy::Nobody, None)),
            (None, None) => {}
        }
        let left_out = LeaveOut::new(path.spectrum, &problem.centred);
        Ok(match problem.groups() {
            Some(groups) => (
                ChosenBy::LeaveOneGroupOut,
                Some(left_out.groups(&groups, &path.penalties, progress)?),
            ),
            None => (
                ChosenBy::LeaveOneOut,
                Some(left_out.singles(&path.penalties, progress)?),
            ),
        })
    }
}

/// Ridge solutions of one fit for every penalty, all computed from one eigendecomposition.
struct Path<'s, 'd, 'a> {
    spectrum: &'s Spectrum<'d, 'a>,
    design: &'d Design<'a>,
    rotated: Mat<f64>,
    penalties: Vec<f64>,
}

impl Path<'_, '_, '_> {
    /// Weights of the features. One column per pair in `columns`, which contains the index of a channel and a penalty.
    fn weights(&self, columns: &[(usize, f64)]) -> Mat<f64> {
        let eigenvalues = self.spectrum.eigenvalues();
        let coefficients = Mat::from_fn(eigenvalues.len(), columns.len(), |row, column| {
            let (channel, penalty) = columns[column];
            self.rotated[(row, channel)] / (eigenvalues[row] + penalty)
        });
        self.spectrum.weights(coefficients.as_ref())
    }

    /// Squared error, averaged over the samples of `part`: one row per penalty, one column per channel.
    fn errors_on(&self, part: &Validation<'_>) -> Errors {
        let channels = self.rotated.ncols();
        let columns: Vec<(usize, f64)> = self
            .penalties
            .iter()
            .flat_map(|&penalty| (0..channels).map(move |channel| (channel, penalty)))
            .collect();
        let weights = self.weights(&columns);
        let predictions = self.design.of(part.features).times(weights.as_ref());
        let errors: Vec<f64> = (0..columns.len())
            .map(|column| {
                let labels = part.labels.col_as_slice(column % channels);
                mean_square(
                    predictions
                        .col_as_slice(column)
                        .iter()
                        .zip(labels)
                        .map(|(p, l)| p - l),
                )
            })
            .collect();
        errors.chunks_exact(channels).map(<[f64]>::to_vec).collect()
    }
}

fn mean_square(differences: impl ExactSizeIterator<Item = f64>) -> f64 {
    let count = differences.len() as f64;
    differences
        .map(|difference| difference * difference)
        .sum::<f64>()
        / count
}

impl LinearEstimator for Ridge {
    fn fit_linear(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<LinearFit, ModelError> {
        let problem = Problem::new(*training)?;
        let validation = problem.validation(validation)?;
        if self.strength.is_some_and(|strength| strength <= 0.0) {
            return self.fit_unpenalised(training, &problem, validation.as_ref(), progress);
        }
        let design = Design::new(training.features, self.scale);
        let spectrum = Spectrum::new(&design, progress)?;
        let unit = match spectrum.mean_eigenvalue() {
            mean if mean > 0.0 => mean,
            // No feature varies: all weights are 0 at every strength.
            _ => 1.0,
        };
        let strengths = self.candidates();
        let path = Path {
            spectrum: &spectrum,
            design: &design,
            rotated: spectrum.rotate(problem.centred.as_ref()),
            penalties: strengths.iter().map(|strength| strength * unit).collect(),
        };
        let (by, errors) = self.choose(&problem, &path, validation.as_ref(), progress)?;
        let chosen: Vec<usize> = (0..problem.channels())
            .map(|channel| errors.as_ref().map_or(0, |errors| least(errors, channel)))
            .collect();
        let choices = chosen.iter().enumerate().map(|(channel, &candidate)| {
            let error = errors.as_ref().map(|errors| errors[candidate][channel]);
            ChannelChoice {
                value: Some(strengths[candidate]),
                rmse: error.and_then(|error| rmse(error, problem.scaling.span()[channel])),
                at_edge: strengths.len() > 1
                    && (candidate == 0 || candidate == strengths.len() - 1),
            }
        });
        let choice = Choice {
            by,
            setting: Some(STRENGTH.key.into()),
            channels: choices.collect(),
        };
        let columns: Vec<(usize, f64)> = chosen
            .iter()
            .map(|&candidate| path.penalties[candidate])
            .enumerate()
            .collect();
        let refitted = self.refit && validation.is_some();
        let regressor = match validation.filter(|_| self.refit) {
            Some(part) => {
                let features = joined(training.features, part.features);
                refit(&problem, &design, &features, &part, &columns, progress)?
            }
            None => {
                let weights = path.weights(&columns);
                LinearRegressor::from_scaled(&problem, &design, &weights, &problem.mean)?
            }
        };
        Ok(LinearFit {
            refitted,
            regressor,
            choice,
            scaling: problem.scaling,
        })
    }
}

/// Fits the final model to the training and validation parts together. `columns` contains each channel's index and chosen penalty.
fn refit(
    problem: &Problem<'_>,
    design: &Design<'_>,
    features: &Features,
    validation: &Validation<'_>,
    columns: &[(usize, f64)],
    progress: &dyn Progress,
) -> Result<LinearRegressor, ModelError> {
    let design = design.recentred(features);
    let spectrum = Spectrum::new(&design, progress)?;
    let (shift, labels) = centred(stacked(&problem.centred, &validation.labels));
    let path = Path {
        rotated: spectrum.rotate(labels.as_ref()),
        spectrum: &spectrum,
        design: &design,
        penalties: Vec::new(),
    };
    let mean: Vec<f64> = problem
        .mean
        .iter()
        .zip(&shift)
        .map(|(mean, shift)| mean + shift)
        .collect();
    LinearRegressor::from_scaled(problem, &design, &path.weights(columns), &mean)
}

estimator!(Ridge, |_| Ridge::INFO.name);
