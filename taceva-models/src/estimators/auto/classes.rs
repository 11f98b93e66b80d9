//! Choice of a classifier by the validation part.

use std::collections::BTreeMap;

use taceva_core::{ErrorKind, ModelError, Progress, Regressor, TrainingSet};

use super::Auto;
use crate::estimators::discriminant::LinearDiscriminant;
use crate::estimators::library::LibraryModel;
use crate::linalg::invalid;
use crate::settings::SettingInfo;
use crate::training::card::{AutoCard, AutoTrial, Untried};
use crate::training::fit::Chosen;
use crate::training::info::ModelInfo;

pub(super) const HEAD: SettingInfo = SettingInfo {
    key: "head",
    accepts: "numbers or classes",
    default: "numbers; classes with --task",
    about: "classes chooses among models that predict one of the training labels, by the validation part",
};

/// Names of the library classifiers among the candidates.
const OF_LIBRARIES: [&str; 2] = ["linfa/logistic", "smartcore/knn-classifier"];

/// Classifiers to try, the simplest first.
fn candidates<'a>(
    libraries: &'a [&'static LibraryModel],
) -> impl Iterator<Item = &'static ModelInfo> + 'a {
    let of_libraries = OF_LIBRARIES.into_iter().filter_map(move |name| {
        let found = libraries.iter().find(|model| model.info.name == name);
        found.map(|model| &model.info)
    });
    std::iter::once(&LinearDiscriminant::INFO).chain(of_libraries)
}

impl Auto {
    /// Fits each classifier to `training` and chooses the classifier with the fewest errors on `held`. The error is the share of wrong predictions
    /// for each distinct label, averaged over these labels. Of equal errors, the simplest classifier is chosen.
    ///
    /// # Errors
    /// [`ModelError`] without a validation part, if no classifier can be fitted, or if `progress` was cancelled.
    pub(super) fn choose_classifier(
        &self,
        training: &TrainingSet<'_>,
        held: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<Chosen, ModelError> {
        let held = held.filter(|held| held.features.samples() > 0);
        let held = held.ok_or_else(|| {
            invalid(
                "auto chooses a classifier by the validation part, but the split has none: name a split with a validation part, or another model",
            )
        })?;
        let (mut tried, mut untried) = (Vec::new(), Vec::new());
        let mut best: Option<(&'static ModelInfo, f64)> = None;
        for info in candidates(&self.libraries) {
            let fit = self.candidate(info)?.map_err(|error| error.to_string());
            let fit = fit.map(|estimator| estimator.fit_model(training, None, progress));
            let wrong = match fit {
                Ok(Ok(fit)) => wrong_share(&fit.regressor, held)?,
                Ok(Err(error)) if error.kind() == ErrorKind::Interrupted => return Err(error),
                Ok(Err(error)) => {
                    untried.push(not_fitted(info, error.to_string()));
                    continue;
                }
                Err(reason) => {
                    untried.push(not_fitted(info, reason));
                    continue;
                }
            };
            tried.push(AutoTrial {
                model: info.name.to_owned(),
                error: wrong,
                cost_s: 0.0,
                folds: 1,
                share: None,
                left: None,
            });
            if best.is_none_or(|(_, least)| wrong < least) {
                best = Some((info, wrong));
            }
        }
        let Some((taken, _)) = best else {
            let reasons = untried.iter().map(|own: &Untried| own.reason.as_str());
            let reasons: Vec<&str> = reasons.collect();
            return Err(invalid(format!(
                "no classifier can be fitted: {}",
                reasons.join("; ")
            )));
        };
        let estimator = self.candidate(taken)?;
        Ok(Chosen {
            estimator: estimator.map_err(|error| invalid(error.to_string()).because(error))?,
            card: AutoCard {
                budget_s: self.budget_s,
                folds: 0,
                by_group: false,
                tried,
                untried,
                taken: taken.name.to_owned(),
            },
            is_closer: false,
        })
    }
}

fn not_fitted(info: &ModelInfo, reason: String) -> Untried {
    Untried {
        model: info.name.to_owned(),
        cost_s: 0.0,
        reason,
    }
}

/// Share of wrong predictions for each distinct label in `set`, averaged over these labels.
fn wrong_share(regressor: &dyn Regressor, set: &TrainingSet<'_>) -> Result<f64, ModelError> {
    let labels = set.targets.values;
    let mut found = vec![0.0; labels.len()];
    regressor.predict(set.features, &mut found)?;
    let mut counts: BTreeMap<u64, [f64; 2]> = BTreeMap::new();
    for (found, label) in found.iter().zip(labels) {
        let [wrong, all] = counts.entry(label.to_bits()).or_default();
        *wrong += f64::from(u8::from(found.total_cmp(label).is_ne()));
        *all += 1.0;
    }
    let shares = counts.values().map(|[wrong, all]| wrong / all);
    Ok(shares.sum::<f64>() / counts.len() as f64)
}
