//! What a model file says of the plugin of its model.

use serde::{Deserialize, Serialize};
use taceva_core::{EstimatorFactory, ModelError};

/// What a card says of the plugin that fitted a model and is needed to predict with it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct PluginCard {
    /// The plugin.
    pub id: String,
    /// The estimator in it, `id/word`.
    pub key: String,
    /// The digest of the library that fitted it, `sha256:…`; `None` where it was linked into the program.
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
