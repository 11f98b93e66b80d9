//! Ensembles of small networks. The members have different seeds, and their predictions are averaged.

mod regressor;

use taceva_core::{ModelError, Progress, SignalInfo, TrainingSet};

pub use self::regressor::EnsembleRegressor;
use self::regressor::MEMBERS_MOST;
use super::{NetworkEstimator, NetworkRegressor};
use crate::features::FeatureError;
use crate::linalg::invalid;
use crate::settings::{ModelSettings, SettingError, SettingInfo, number};
use crate::training::choice::{Choice, errors};
use crate::training::fit::{ModelEstimator, ModelFit, estimator};
use crate::training::info::ModelInfo;
use crate::training::regressor::ModelRegressor;

/// Unfitted ensemble: small networks of different seeds, to be fitted to the same samples. Predictions are averaged over the networks.
#[derive(Clone, Debug, PartialEq)]
pub struct NetworkEnsemble {
    members: Vec<NetworkEstimator>,
}

const MEMBERS: SettingInfo = SettingInfo {
    key: "members",
    accepts: "a whole number from 2 to 16",
    default: "2",
    about: "number of networks, with consecutive seeds from seed on; fitting and predicting take that many times longer",
};

const OF_EACH: &[SettingInfo] = NetworkEstimator::CNN.settings;

/// Settings of an ensemble in the model registry: settings of each small network, and the number of networks.
const SETTINGS: [SettingInfo; OF_EACH.len() + 1] = {
    let mut all = [MEMBERS; OF_EACH.len() + 1];
    let mut at = 0;
    while at < OF_EACH.len() {
        all[at] = OF_EACH[at];
        at += 1;
    }
    all
};

impl NetworkEnsemble {
    /// Entry of the ensemble in the model registry.
    pub const INFO: ModelInfo = ModelInfo {
        name: "cnn-ensemble",
        about: "the mean of several cnn of different seeds",
        settings: &SETTINGS,
        features: NetworkEstimator::CNN.features,
        make: |settings| Ok(Box::new(NetworkEnsemble::from_settings(settings)?)),
        load: EnsembleRegressor::load,
    };

    /// Builds the estimator from `settings`.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn from_settings(settings: &ModelSettings) -> Result<NetworkEnsemble, SettingError> {
        settings.check_keys(&SETTINGS)?;
        let (own, of_each) = settings.clone().partition(&[MEMBERS]);
        let count = own.value(&MEMBERS, 2, |text| number(text, 2..=MEMBERS_MOST))?;
        let first = NetworkEstimator::cnn(&of_each)?;
        let members = (0_u64..)
            .take(count)
            .map(|number| first.with_later_seed(number));
        Ok(NetworkEnsemble {
            members: members.collect(),
        })
    }
}

impl ModelEstimator for NetworkEnsemble {
    fn of_signals(
        &self,
        info: SignalInfo,
    ) -> Result<Option<Box<dyn ModelEstimator>>, FeatureError> {
        let members = self.members.iter().map(|own| own.for_signals(info));
        Ok(Some(Box::new(NetworkEnsemble {
            members: members.collect::<Result<_, _>>()?,
        })))
    }

    fn fit_model(
        &self,
        training: &TrainingSet<'_>,
        validation: Option<&TrainingSet<'_>>,
        progress: &dyn Progress,
    ) -> Result<ModelFit, ModelError> {
        let (mut networks, mut last) = (Vec::new(), None);
        for member in &self.members {
            let fit = member.fit_model(training, validation, progress)?;
            let network = fit.regressor.get::<NetworkRegressor>();
            let network = network.ok_or_else(|| {
                invalid("head=classes: an ensemble averages numbers, expected head=numbers")
            })?;
            networks.push(network.clone());
            last = Some(fit);
        }
        let last = last.ok_or_else(|| invalid("an ensemble without members"))?;
        let regressor = EnsembleRegressor::new(networks)?;
        let is_scored = |set: &&TrainingSet<'_>| set.features.samples() > 0;
        let errors = match validation.filter(is_scored) {
            Some(set) => errors(&regressor, set)?,
            None => vec![None; training.targets.channels.len()],
        };
        Ok(ModelFit {
            // Each member has its own best epoch, so no single value is reported.
            choice: Choice {
                by: last.choice.by,
                ..Choice::nobodys(errors)
            },
            regressor: ModelRegressor::new(regressor),
            scaling: last.scaling,
            refitted: false,
        })
    }
}

estimator!(NetworkEnsemble, |_| NetworkEnsemble::INFO.name);
