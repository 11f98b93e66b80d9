//! Models available to a program: built-in models, library models and plugin models.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::Arc;

use taceva_core::{Args, EstimatorFactory};

use crate::estimators::auto::Auto;
use crate::estimators::library::LibraryModel;
use crate::estimators::plugin::PluginEstimator;
use crate::estimators::registry::{ALL, PRESETS, Preset, UnknownModel};
use crate::features::FeatureSpec;
use crate::settings::{ModelSettings, SettingError};
use crate::training::fit::ModelEstimator;
use crate::training::info::ModelInfo;

/// Available models, found by name. A program creates this value and passes it on, like its drivers. There is no global state.
///
/// ```
/// use taceva_models::{Models, ModelSettings};
/// let ridge = Models::builtin().find("ridge")?;
/// let estimator = ridge.estimator(&ModelSettings::parse(["strength=0.1"])?)?;
/// assert_eq!(estimator.name(), "ridge");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Default)]
pub struct Models {
    offered: BTreeMap<String, Arc<dyn EstimatorFactory>>,
    libraries: Vec<&'static LibraryModel>,
}

impl Models {
    /// Creates a collection of the built-in models.
    pub fn builtin() -> Models {
        Models::default()
    }

    /// Adds plugin models, which are found by their keys. Keys contain a `/`; names of built-in models do not.
    #[must_use]
    pub fn with(mut self, offered: impl IntoIterator<Item = Arc<dyn EstimatorFactory>>) -> Models {
        let named = offered.into_iter();
        let named = named.map(|factory| (factory.key().to_string(), factory));
        self.offered.extend(named);
        self
    }

    /// Adds library models. `auto` then also tries these models, and their model files can be read.
    #[must_use]
    pub fn with_libraries(
        mut self,
        libraries: impl IntoIterator<Item = &'static LibraryModel>,
    ) -> Models {
        self.libraries.extend(libraries);
        self
    }

    /// Built-in models, the simplest first, and then library models.
    pub fn compiled(&self) -> impl Iterator<Item = &'static ModelInfo> + '_ {
        let of_libraries = self.libraries.iter().map(|model| &model.info);
        ALL.iter().chain(of_libraries)
    }

    /// Finds the model `name`.
    ///
    /// # Errors
    /// [`UnknownModel`] with the most similar name, or with the missing plugin or feature.
    pub fn find(&self, name: &str) -> Result<ChosenModel, UnknownModel> {
        if let Some(factory) = self.offered(name) {
            return Ok(ChosenModel::Offered(Arc::clone(factory)));
        }
        if name == Auto::INFO.name {
            return Ok(ChosenModel::Auto(self.libraries.clone().into()));
        }
        if let Some(model) = self.library(name) {
            return Ok(ChosenModel::Library(model));
        }
        let built_in = ALL.iter().find(|info| info.name == name);
        let names = self.compiled().map(|info| info.name);
        built_in.map(ChosenModel::BuiltIn).ok_or_else(|| {
            let presets = PRESETS.iter().map(|preset| preset.name);
            let offered = self.offered.keys().map(String::as_str);
            UnknownModel::new(name, names.chain(presets).chain(offered))
        })
    }

    /// Finds the model or [`Preset`] `name`, and returns the model with its settings. Settings in `given` override the settings of the preset.
    ///
    /// ```
    /// use taceva_models::{Models, ModelSettings};
    /// let given = ModelSettings::parse(["jitter=0"])?;
    /// let (model, settings) = Models::builtin().asked("fast", given)?;
    /// assert_eq!((model.name(), settings.get("jitter")), ("cnn", Some("0")));
    /// assert!(settings.get("size").is_some());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Errors of [`find`](Models::find).
    pub fn asked(
        &self,
        name: &str,
        given: ModelSettings,
    ) -> Result<(ChosenModel, ModelSettings), UnknownModel> {
        match Preset::named(name) {
            Some(preset) => Ok((self.find(preset.model)?, preset.changed_by(given))),
            None => Ok((self.find(name)?, given)),
        }
    }

    /// Finds the library model `name`; `None` for an unknown name.
    pub(crate) fn library(&self, name: &str) -> Option<&'static LibraryModel> {
        let mut libraries = self.libraries.iter().copied();
        libraries.find(|model| model.info.name == name)
    }

    /// Finds the plugin estimator `key`; `None` for an unknown key.
    pub(crate) fn offered(&self, key: &str) -> Option<&Arc<dyn EstimatorFactory>> {
        self.offered.get(key)
    }
}

impl fmt::Debug for Models {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let names = self.compiled().map(|info| info.name);
        let offered = self.offered.keys().map(String::as_str);
        f.debug_set().entries(names.chain(offered)).finish()
    }
}

/// A model chosen by name, before its fit.
#[derive(Clone)]
pub enum ChosenModel {
    /// Built-in model.
    BuiltIn(&'static ModelInfo),
    /// Library model.
    Library(&'static LibraryModel),
    /// Automatic choice among built-in models and these library models.
    Auto(Arc<[&'static LibraryModel]>),
    /// Plugin model.
    Offered(Arc<dyn EstimatorFactory>),
}

impl ChosenModel {
    /// Registry entry; `None` for a plugin model.
    fn info(&self) -> Option<&'static ModelInfo> {
        match self {
            ChosenModel::BuiltIn(info) => Some(info),
            ChosenModel::Library(model) => Some(&model.info),
            ChosenModel::Auto(_) => Some(&Auto::INFO),
            ChosenModel::Offered(_) => None,
        }
    }

    /// Name of the model on the command line.
    pub fn name(&self) -> &str {
        match self {
            ChosenModel::BuiltIn(info) => info.name,
            ChosenModel::Library(model) => model.info.name,
            ChosenModel::Auto(_) => Auto::INFO.name,
            ChosenModel::Offered(factory) => factory.key().as_str(),
        }
    }

    /// True if predictions depend on features. Otherwise the caller need not decode frames.
    pub fn reads_features(&self) -> bool {
        self.info().is_none_or(|info| info.features.is_some())
    }

    /// Default features of the model.
    pub fn features(&self) -> FeatureSpec {
        let own = self.info().and_then(|info| info.features);
        own.unwrap_or_default()
    }

    /// Default features on a finer grid, which only the model `auto` has; `None` for any other model.
    pub fn closer_features(&self) -> Option<FeatureSpec> {
        match self {
            ChosenModel::Auto(_) => Auto::CLOSER,
            _ => None,
        }
    }

    /// Keys of all settings of the model.
    pub fn setting_keys(&self) -> Vec<&str> {
        if let ChosenModel::Offered(factory) = self {
            let settings = factory.settings().iter();
            return settings.map(|setting| setting.key.as_str()).collect();
        }
        let settings = self.info().map_or(&[][..], |info| info.settings);
        settings.iter().map(|info| info.key).collect()
    }

    /// Builds the estimator from `settings`.
    ///
    /// # Errors
    /// [`SettingError`] for an unknown key or a value out of range.
    pub fn estimator(
        &self,
        settings: &ModelSettings,
    ) -> Result<Box<dyn ModelEstimator>, SettingError> {
        match self {
            ChosenModel::BuiltIn(info) => info.estimator(settings),
            ChosenModel::Library(model) => model.info.estimator(settings),
            ChosenModel::Auto(libraries) => {
                let auto = Auto::from_settings(settings)?;
                Ok(Box::new(auto.among(libraries)))
            }
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

/// Formats the name of the model, with the release of each library, or with the build of a plugin.
impl fmt::Debug for ChosenModel {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ChosenModel::BuiltIn(info) => f.write_str(info.name),
            ChosenModel::Library(model) => write!(f, "{} {}", model.info.name, model.release),
            ChosenModel::Auto(libraries) => {
                f.write_str(Auto::INFO.name)?;
                let models = libraries.iter();
                let mut models = models.map(|model| (model.info.name, model.release));
                models.try_for_each(|(name, release)| write!(f, " {name} {release}"))
            }
            ChosenModel::Offered(factory) => write!(f, "{} {:?}", self.name(), factory.build()),
        }
    }
}
