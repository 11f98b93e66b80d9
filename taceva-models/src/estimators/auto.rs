//! The model that does best on groups left out, within a budget of work.

mod card;
mod cost;
mod validate;

use taceva_core::{ModelError, Progress, SignalInfo, TrainingSet};

pub use self::card::{AutoCard, AutoTrial, Untried};
use self::cost::{Sizes, seconds, trying};
use self::validate::{FOLDS, Folds};
use crate::estimators::library::{LibraryModel, LibrarySizes};
use crate::features::{FeatureError, FeatureSpec};
use crate::registry::{ALL, ModelInfo};
use crate::settings::{ModelSettings, SettingError, SettingInfo, number};
use crate::training::fit::{Chosen, ModelEstimator, ModelFit, estimator};
use crate::training::problem::{Problem, invalid};
use crate::training::progress::{ReportedStage, interrupted};

/// Tries models, the cheapest first, as long as the budget lasts, and chooses the one of least error.
///
/// Each is fitted five times: one fold is scored, the next chooses its settings, the other three are learnt from; folds are whole groups of
/// the training part, or runs of neighbouring samples. Its error is the root mean square over all folds, relative to the deviation of the
/// labels and averaged over channels that vary.
///
/// The budget is counted in work, not by a clock: seconds of a core that does a thousand million multiplications each second. What a
/// model takes follows from the numbers of samples, features and channels, so that the same recording leads to the same choice on every
/// machine, under any load and on any number of threads. The baseline and ridge are always tried.
#[derive(Clone, Debug)]
pub struct Auto {
    budget_s: f64,
    /// Models of libraries that are tried beside those of this crate.
    libraries: Vec<&'static LibraryModel>,
    /// The signals that are learnt from, where they are no pictures.
    of_signals: Option<SignalInfo>,
}

const BUDGET: SettingInfo = SettingInfo {
    key: "budget_s",
    accepts: "a number from 0 to 1e6",
    default: "60",
    about: "work to spend on trying models, in seconds of a core of a thousand million multiplications each",
};

impl Auto {
    /// What the registry says of it.
    pub const INFO: ModelInfo = ModelInfo {
        name: "auto",
        about: "whichever of the others does best on groups left out, within a budget of work",
        settings: &[BUDGET],
        features: Some(FeatureSpec::DEFAULT),
        make: |settings| Ok(Box::new(Auto::from_settings(settings)?)),
    };

    /// The choice as `settings` ask for.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn from_settings(settings: &ModelSettings) -> Result<Auto, SettingError> {
        settings.check_keys(Auto::INFO.settings)?;
        Ok(Auto {
            budget_s: settings.value(&BUDGET, 60.0, |text| number(text, 0.0..=1e6))?,
            libraries: Vec::new(),
            of_signals: None,
        })
    }

    /// The choice among models of libraries too.
    #[must_use]
    pub fn among(mut self, libraries: &[&'static LibraryModel]) -> Auto {
        self.libraries.extend(libraries);
        self
    }

    /// The models that can be tried on samples of these sizes, the cheapest first, with what each takes.
    fn candidates(&self, sizes: Sizes) -> Vec<(&'static ModelInfo, f64)> {
        let models = ALL.iter().filter(|info| info.name != Auto::INFO.name);
        let costed = models.filter_map(|info| Some((info, seconds(info.name, sizes)?)));
        let of_libraries = self.libraries.iter().filter_map(|model| {
            let work = (model.work)(learnt(sizes))?;
            Some((&model.info, trying(work)))
        });
        let mut candidates: Vec<_> = costed.chain(of_libraries).collect();
        // Of equals the first in the list comes first: the plainer.
        candidates.sort_by(|left, right| left.1.total_cmp(&right.1));
        candidates
    }
}

/// The sizes of the part of a training part that a trial learns from.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "sizes of a recording in memory"
)]
fn learnt(sizes: Sizes) -> LibrarySizes {
    LibrarySizes {
        samples: (0.8 * sizes.samples) as usize,
        features: sizes.features as usize,
        targets: sizes.channels as usize,
    }
}

impl Auto {
    /// The model of `info` with default settings, as it learns from what is looked at here.
    fn candidate(
        &self,
        info: &ModelInfo,
    ) -> Result<Result<Box<dyn ModelEstimator>, FeatureError>, ModelError> {
        let estimator = info
            .estimator(&ModelSettings::default())
            .map_err(|error| invalid(error.to_string()).because(error))?;
        let of_signals = self.of_signals.map(|info| estimator.of_signals(info));
        Ok(match of_signals.transpose() {
            Ok(other) => Ok(other.flatten().unwrap_or(estimator)),
            Err(error) => Err(error),
        })
    }
}

/// Models that are tried whatever the budget.
const ALWAYS: [&str; 2] = ["baseline", "ridge"];

impl ModelEstimator for Auto {
    fn of_signals(
        &self,
        info: SignalInfo,
    ) -> Result<Option<Box<dyn ModelEstimator>>, FeatureError> {
        let mut own = self.clone();
        own.of_signals = Some(info);
        Ok(Some(Box::new(own)))
    }

    fn choose(
        &self,
        training: &TrainingSet<'_>,
        progress: &dyn Progress,
    ) -> Result<Option<Chosen>, ModelError> {
        let problem = Problem::new(*training)?;
        let samples = training.features.samples();
        if samples < FOLDS {
            return Err(invalid(format!(
                "{samples} training samples, at least {FOLDS} are needed to try models on"
            )));
        }
        let folds = Folds::new(training, problem.groups());
        let shape = training.features.shape();
        let sizes = Sizes {
            samples: samples as f64,
            features: shape.len() as f64,
            channels: problem.channels() as f64,
            is_picture: shape.height > 1,
        };
        let candidates = self.candidates(sizes);
        let mut spent_s = 0.0;
        let (mut tried, mut untried) = (Vec::new(), Vec::new());
        let stage = ReportedStage::begin(progress, "models tried", candidates.len());
        for (info, cost_s) in candidates {
            interrupted(progress)?;
            let affordable = spent_s + cost_s <= self.budget_s;
            if affordable || ALWAYS.contains(&info.name) {
                let error = match self.candidate(info)? {
                    Ok(estimator) => folds.error(training, &*estimator, progress)?,
                    Err(unsuited) => Err(unsuited.to_string()),
                };
                match error {
                    Ok(error) => {
                        spent_s += cost_s;
                        tried.push(AutoTrial {
                            model: info.name.to_owned(),
                            error,
                            cost_s,
                        });
                    }
                    Err(reason) => untried.push(Untried {
                        model: info.name.to_owned(),
                        cost_s,
                        reason,
                    }),
                }
            } else {
                untried.push(Untried {
                    model: info.name.to_owned(),
                    cost_s,
                    reason: "beyond the budget".to_owned(),
                });
            }
            stage.advance();
        }
        let card = AutoCard {
            budget_s: self.budget_s,
            folds: FOLDS,
            by_group: folds.by_group,
            tried,
            untried,
        };
        let libraries = self.libraries.iter().map(|model| &model.info);
        let info = ALL
            .iter()
            .chain(libraries)
            .find(|info| Some(info.name) == card.best().map(|trial| trial.model.as_str()))
            .ok_or_else(|| invalid("no model could be tried"))?;
        let estimator = self.candidate(info)?;
        let estimator = estimator.map_err(|error| invalid(error.to_string()).because(error))?;
        Ok(Some(Chosen { estimator, card }))
    }

    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let chosen = self.choose(training, progress)?;
        let chosen = chosen.expect("this estimator chooses");
        chosen.estimator.fit_model(training, validation, progress)
    }
}

estimator!(Auto, |_| Auto::INFO.name);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn candidates_come_by_cost_and_residual_networks_last() {
        let sizes = Sizes {
            samples: 500.0,
            features: 1024.0,
            channels: 3.0,
            is_picture: true,
        };
        let auto = Auto::from_settings(&ModelSettings::default()).expect("no setting");
        let candidates = auto.candidates(sizes);
        assert_eq!(candidates[0].0.name, "baseline");
        assert_eq!(candidates.last().expect("some").0.name, "resnet34");
        assert_eq!(candidates.len(), ALL.len() - 1);
        let flat = Sizes {
            is_picture: false,
            ..sizes
        };
        let networks = |name: &str| name == "cnn" || name.starts_with("resnet");
        assert!(
            auto.candidates(flat)
                .iter()
                .all(|(info, _)| !networks(info.name))
        );
    }
}
