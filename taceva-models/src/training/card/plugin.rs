//! Card entry for the plugin that fitted a model.

use serde::{Deserialize, Serialize};
use taceva_core::{EstimatorFactory, ModelError};

/// Plugin that fitted a model and is needed for predictions.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PluginCard {
    /// Id of the plugin.
    pub id: String,
    /// Key of the plugin's estimator: the id of the plugin, `/` and the name of the estimator.
    pub key: String,
    /// Digest of the plugin library, `sha256:…`; `None` if the plugin was linked into the program.
    pub build: Option<String>,
}

impl PluginCard {
    pub(crate) fn of(factory: &dyn EstimatorFactory) -> Result<PluginCard, ModelError> {
        let key = factory.key().as_str();
        let (id, _) = key.rsplit_once('/').unwrap_or((key, ""));
        Ok(PluginCard {
            id: id.to_owned(),
            key: key.to_owned(),
            build: factory.build()?,
        })
    }
}
