//! Registry that finds models by name.

mod preset;

pub(crate) use preset::DEFAULT;
pub use preset::{PRESETS, Preset};

use std::fmt;

use crate::estimators::auto::Auto;
use crate::estimators::baseline::Baseline;
use crate::estimators::discriminant::LinearDiscriminant;
use crate::estimators::elastic_net::ElasticNet;
use crate::estimators::kernel::{GaussianProcess, KernelRidge};
use crate::estimators::library::library_of;
use crate::estimators::neighbours::Neighbours;
use crate::estimators::network::{NetworkEnsemble, NetworkEstimator};
use crate::estimators::pls::Pls;
use crate::estimators::ridge::Ridge;
use crate::estimators::trees::{GradientBoosting, RandomForest};
use crate::settings::Suggestion;
use crate::training::info::ModelInfo;

/// All built-in models, the simplest first.
pub const ALL: &[ModelInfo] = &[
    Baseline::INFO,
    Ridge::INFO,
    Pls::INFO,
    ElasticNet::INFO,
    KernelRidge::INFO,
    GaussianProcess::INFO,
    Neighbours::INFO,
    LinearDiscriminant::INFO,
    RandomForest::INFO,
    GradientBoosting::INFO,
    NetworkEstimator::CNN,
    NetworkEstimator::RESNET_10,
    NetworkEstimator::RESNET_18,
    NetworkEstimator::RESNET_34,
    NetworkEnsemble::INFO,
    Auto::INFO,
];

/// Finds the model `name`.
///
/// ```
/// let ridge = taceva_models::find("ridge")?;
/// let estimator = ridge.estimator(&taceva_models::ModelSettings::parse(["strength=0.1"])?)?;
/// assert_eq!(estimator.name(), "ridge");
/// let error = taceva_models::find("rigde").unwrap_err();
/// assert_eq!(error.to_string(), "no model is called `rigde`, did you mean `ridge`?");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`UnknownModel`] with the most similar name.
pub fn find(name: &str) -> Result<&'static ModelInfo, UnknownModel> {
    ALL.iter()
        .find(|info| info.name == name)
        .ok_or_else(|| UnknownModel::new(name, ALL.iter().map(|info| info.name)))
}

/// Error for an unknown model name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnknownModel {
    name: String,
    suggestion: Suggestion,
    /// Cargo feature that contains the model, if this program was built without it. `None` for any other unknown name.
    feature: Option<&'static str>,
}

impl UnknownModel {
    pub(crate) fn new<'a>(name: &str, known: impl IntoIterator<Item = &'a str>) -> UnknownModel {
        let known: Vec<&str> = known.into_iter().collect();
        let library = library_of(name);
        let offers = |library: &str| known.iter().any(|known| library_of(known) == Some(library));
        let whole = known
            .iter()
            .find(|known| known.rsplit_once('/').is_some_and(|(_, key)| key == name));
        UnknownModel {
            name: name.to_owned(),
            feature: library.filter(|library| !offers(library)),
            suggestion: match whole {
                Some(whole) => Suggestion::meaning(whole),
                None => Suggestion::of(name, known),
            },
        }
    }
}

impl fmt::Display for UnknownModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let name = taceva_core::shown(&self.name);
        if let Some(feature) = self.feature {
            return write!(
                f,
                "`{name}`: this program was built without the feature `{feature}`: build it with `--features {feature}`"
            );
        }
        let is_of_plugin = library_of(&self.name).is_none() && self.name.contains('/');
        match (is_of_plugin, self.suggestion.nearest()) {
            (true, None) => write!(
                f,
                "no available plugin has the model `{name}`: give the folder of its plugin.toml by `--plugin-dir`; `taceva plugin list` shows the plugins that are found"
            ),
            (true, Some(_)) => write!(
                f,
                "no available plugin has the model `{name}`, {}",
                self.suggestion
            ),
            (false, _) => write!(f, "no model is called `{name}`, {}", self.suggestion),
        }
    }
}

impl std::error::Error for UnknownModel {}
