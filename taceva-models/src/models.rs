//! The models of a program: those that are built in, and those that plugins offer.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use taceva_core::{Args, EstimatorFactory};

use crate::features::FeatureSpec;
use crate::fit::ModelEstimator;
use crate::plugin::PluginEstimator;
use crate::registry::{ALL, ModelInfo, UnknownModel};
use crate::settings::{SettingError, Settings};

/// The models that people can choose, by name. A value, as the drivers of a program are: nothing of it is global.
///
/// ```
/// use taceva_models::{Models, Settings};
/// let ridge = Models::builtin().find("ridge")?;
/// let estimator = ridge.estimator(&Settings::parse(["strength=0.1"])?)?;
/// assert_eq!(estimator.name(), "ridge");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Default)]
pub struct Models {
    offered: BTreeMap<String, Arc<dyn EstimatorFactory>>,
}

impl Models {
    /// The models that are built in.
    pub fn builtin() -> Models {
        Models::default()
    }

    /// These models and those that `offered` makes, by their keys. Keys have a `/` and names that are built in have none.
    #[must_use]
    pub fn with(mut self, offered: impl IntoIterator<Item = Arc<dyn EstimatorFactory>>) -> Models {
        let named = offered.into_iter();
        let named = named.map(|factory| (factory.key().to_string(), factory));
        self.offered.extend(named);
        self
    }

    /// The model called `name`.
    ///
    /// # Errors
    /// [`UnknownModel`] with the nearest name, or with the plugin that it would be of.
    pub fn find(&self, name: &str) -> Result<ChosenModel, UnknownModel> {
        if let Some(factory) = self.offered(name) {
            return Ok(ChosenModel::Offered(Arc::clone(factory)));
        }
        let built_in = ALL.iter().find(|info| info.name == name);
        let names = ALL.iter().map(|info| info.name);
        built_in.map(ChosenModel::from).ok_or_else(|| {
            UnknownModel::new(name, names.chain(self.offered.keys().map(String::as_str)))
        })
    }

    /// What makes and loads the models called `key`, where a plugin does.
    pub(crate) fn offered(&self, key: &str) -> Option<&Arc<dyn EstimatorFactory>> {
        self.offered.get(key)
    }
}

impl fmt::Debug for Models {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = ALL.iter().map(|info| info.name);
        let offered = self.offered.keys().map(String::as_str);
        f.debug_set().entries(names.chain(offered)).finish()
    }
}

/// A model that was chosen by its name, not fitted yet.
#[derive(Clone)]
pub enum ChosenModel {
    /// One that is built in.
    BuiltIn(&'static ModelInfo),
    /// One that a plugin offers.
    Offered(Arc<dyn EstimatorFactory>),
}

impl ChosenModel {
    /// The word people type.
    pub fn name(&self) -> &str {
        match self {
            ChosenModel::BuiltIn(info) => info.name,
            ChosenModel::Offered(factory) => factory.key().as_str(),
        }
    }

    /// Whether its predictions depend on what is seen; if not, no frame need be decoded for it.
    pub fn reads_features(&self) -> bool {
        match self {
            ChosenModel::BuiltIn(info) => info.features.is_some(),
            ChosenModel::Offered(_) => true,
        }
    }

    /// What it sees of a frame where nothing else is asked for.
    pub fn features(&self) -> FeatureSpec {
        match self {
            ChosenModel::BuiltIn(info) => info.features.unwrap_or_default(),
            ChosenModel::Offered(_) => FeatureSpec::default(),
        }
    }

    /// The keys of what can be set.
    pub fn setting_keys(&self) -> Vec<&str> {
        match self {
            ChosenModel::BuiltIn(info) => info.settings.iter().map(|info| info.key).collect(),
            ChosenModel::Offered(factory) => {
                let settings = factory.settings().iter();
                settings.map(|setting| setting.key.as_str()).collect()
            }
        }
    }

    /// The model as `settings` ask for, not fitted yet.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn estimator(&self, settings: &Settings) -> Result<Box<dyn ModelEstimator>, SettingError> {
        match self {
            ChosenModel::BuiltIn(info) => info.estimator(settings),
            ChosenModel::Offered(factory) => Ok(Box::new(PluginEstimator {
                settings: Args::from_pairs(factory.settings(), settings.iter())?,
                factory: Arc::clone(factory),
            })),
        }
    }
}

impl From<&'static ModelInfo> for ChosenModel {
    fn from(info: &'static ModelInfo) -> ChosenModel {
        ChosenModel::BuiltIn(info)
    }
}

/// The name, and the build where that is not the program's: what decides which model it is.
impl fmt::Debug for ChosenModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ChosenModel::BuiltIn(info) => f.write_str(info.name),
            ChosenModel::Offered(factory) => write!(f, "{} {:?}", self.name(), factory.build()),
        }
    }
}
