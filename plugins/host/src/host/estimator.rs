//! Estimator of a plugin. The manifest describes the estimator, and the library fits and loads models.

use std::fmt;
use std::sync::{Arc, OnceLock};

use taceva_core::{
    ArgSpec, DriverError, DriverKey, ErrorKind, EstimatorFactory, FitRequest, ModelError, Saved,
    SavedRegressor,
};

use super::PluginHost;
use crate::library::Level;
use crate::manifest::{EstimatorInfo, Sha256Digest};
use crate::search::Plugin;
use crate::session::Session;

/// Estimator of a plugin. A saved model has the format of the plugin and the digest of the library.
struct PluginEstimator {
    host: Arc<PluginHost>,
    plugin: Plugin,
    info: EstimatorInfo,
    /// Digest of the first library that was read. Later builds must have the same digest.
    built: OnceLock<Sha256Digest>,
}

impl PluginHost {
    /// Estimator factories of every plugin, ordered by the id of the plugin.
    pub fn models(self: &Arc<PluginHost>) -> Vec<Arc<dyn EstimatorFactory>> {
        let estimators = self.estimators().map(|(plugin, info)| {
            let estimator: Arc<dyn EstimatorFactory> = Arc::new(PluginEstimator {
                host: Arc::clone(self),
                plugin: plugin.clone(),
                info: info.clone(),
                built: OnceLock::new(),
            });
            estimator
        });
        estimators.collect()
    }
}

impl PluginEstimator {
    fn session(&self) -> Result<Arc<dyn Session>, ModelError> {
        let started = self.host.start(&self.plugin, &self.info.key);
        let (session, digest) = started.map_err(of_driver)?;
        self.built.get_or_init(|| digest);
        Ok(session)
    }

    fn digest(&self) -> Result<Sha256Digest, ModelError> {
        if let Some(digest) = self.built.get() {
            return Ok(*digest);
        }
        let code = self.plugin.read(&self.info.key).map_err(of_driver)?;
        let digest = code.digest();
        Ok(*self.built.get_or_init(|| digest))
    }
}

impl EstimatorFactory for PluginEstimator {
    fn key(&self) -> &DriverKey {
        &self.info.key
    }

    fn title(&self) -> &str {
        &self.info.title
    }

    fn settings(&self) -> &[ArgSpec] {
        &self.info.settings
    }

    fn fit(&self, request: &FitRequest<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
        self.session()?.fit(&self.info.key, request)
    }

    fn load(&self, saved: &Saved<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
        self.session()?.load(&self.info.key, saved)
    }

    fn build(&self) -> Result<Option<String>, ModelError> {
        Ok(Some(format!("sha256:{}", self.digest()?)))
    }

    /// Checks the build that fitted a model. A manifest that pins a build rejects models of other builds; otherwise the difference is logged.
    fn admit(&self, fitted_by: Option<&str>) -> Result<(), ModelError> {
        let build = format!("sha256:{}", self.digest()?);
        if fitted_by == Some(build.as_str()) {
            return Ok(());
        }
        let remedy = match fitted_by {
            Some(_) => ": the plugin changed since the fit; fit again to use its present code",
            None => "",
        };
        let fitted_by =
            crate::text::shown(fitted_by.unwrap_or("a program that it was linked into"));
        let key = &self.info.key;
        let library = self.plugin.library();
        if library.is_some_and(|library| library.sha256.is_some()) {
            let why = format!(
                "{key}: the model was fitted by {fitted_by}, but the manifest allows only {build}"
            );
            return Err(ModelError::new(ErrorKind::PermissionDenied, why));
        }
        let line = format!("the model was fitted by {fitted_by}, but {build} is used{remedy}");
        (self.host.log)(self.plugin.id(), Level::Warn, key.as_str(), &line);
        Ok(())
    }
}

impl fmt::Debug for PluginEstimator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "PluginEstimator({})", self.info.key)
    }
}

/// Converts a driver error into a model error.
fn of_driver(error: DriverError) -> ModelError {
    ModelError::new(error.kind(), error.to_string()).because(error)
}
