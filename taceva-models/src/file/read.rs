//! Reads model files, and checks every size, version, shape and number.

use safetensors::tensor::SafeTensors;
use serde::Deserialize;
use taceva_core::InputInfo;

use super::bytes::check_sizes;
use super::distance::distance_from;
use super::seal::check_seal;
use crate::estimators::plugin::PluginRegressor;
use crate::model::{Model, channels_of, learnt_channels_of};
use crate::models::Models;
use crate::training::card::{LibraryCard, ModelCard};
use crate::training::file::content::Stored;
use crate::training::file::error::FormatError;
use crate::training::file::limits::{CARD, FORMAT};
use crate::training::file::tensors::Tensors;
use crate::training::regressor::ModelRegressor;

/// Release of TacEva that introduced format 1.0.
const SINCE: [u32; 2] = [0, 2];

/// Part of a card that is common to all format versions.
#[derive(Deserialize)]
struct Version {
    format: String,
    #[serde(default)]
    taceva: String,
}

impl Models {
    /// Reads a model from `bytes`. Models of a plugin are loaded by the plugin.
    ///
    /// # Errors
    /// [`FormatError`] if the bytes differ from the format of [`to_bytes`](Model::to_bytes), or have another major version. The same error reports a
    /// plugin that is missing or rejects the bytes.
    pub fn read(&self, bytes: &[u8]) -> Result<Model, FormatError> {
        check_sizes(bytes)?;
        let (_, header) = SafeTensors::read_metadata(bytes)?;
        let text = header
            .metadata()
            .as_ref()
            .and_then(|metadata| metadata.get(CARD))
            .ok_or(FormatError::NoCard)?;
        check_version(&serde_json::from_str(text)?)?;
        let opened = SafeTensors::deserialize(bytes)?;
        check_seal(text, &opened)?;
        let card: ModelCard = serde_json::from_str(text)?;
        let channels = channels_of(&card)?;
        let labels = card.channels.iter().all(|channel| {
            channel.minimum.is_finite() && channel.span.is_finite() && channel.span > 0.0
        });
        if !card.features.is_valid()
            || !is_of_its_input(&card)
            || card.choice.channels.len() != channels.len()
            || !(0.0..=1e6).contains(&card.margin)
            || !labels
        {
            return Err(FormatError::Card);
        }
        let learnt = learnt_channels_of(&card, &channels)?;
        let stored = Stored {
            tensors: Tensors(opened),
            card: &card,
            channels,
        };
        let regressor = self.load(&stored)?;
        if regressor.kind() != card.kind() {
            return Err(FormatError::Card);
        }
        let distance = distance_from(&stored)?;
        Ok(Model {
            card,
            regressor,
            channels: learnt,
            distance,
        })
    }

    /// Loads the regressor, by the plugin or registry entry that the card names.
    fn load(&self, stored: &Stored<'_>) -> Result<ModelRegressor, FormatError> {
        let card = stored.card;
        if let Some(plugin) = &card.plugin {
            let factory = self.offered(&plugin.key);
            let factory = factory.ok_or_else(|| FormatError::NoPlugin {
                id: plugin.id.clone(),
                key: plugin.key.clone(),
            })?;
            return PluginRegressor::load(&**factory, plugin, stored);
        }
        let model = || card.model.clone();
        match self.compiled().find(|info| info.name == card.model) {
            Some(info) => (info.load)(stored),
            None => Err(match &card.library {
                Some(LibraryCard { feature, .. }) => FormatError::NoLibrary {
                    model: model(),
                    feature: feature.clone(),
                },
                None => FormatError::NoModel { model: model() },
            }),
        }
    }
}

/// True if all entries of a card are consistent with its input: frames or signals.
fn is_of_its_input(card: &ModelCard) -> bool {
    match (card.input, &card.spread) {
        (InputInfo::Frame(_), None) => card.features.channels.is_none(),
        (InputInfo::Signals(info), Some(spread)) => {
            let is_divisor = |spread: &f64| spread.is_finite() && *spread > 0.0;
            card.features.of_signals(info) == card.features
                && spread.len() == card.features.shape().depth
                && spread.iter().all(is_divisor)
        }
        _ => false,
    }
}

/// Accepts every minor version of the supported major version, because minor versions only add entries.
fn check_version(found: &Version) -> Result<(), FormatError> {
    let parts = |version: &str| -> Option<[u32; 2]> {
        let mut parts = version.split('.').map(|part| part.parse().ok());
        Some([parts.next()??, parts.next()??])
    };
    let is_earlier = parts(&found.taceva).is_some_and(|release| release < SINCE);
    let [major, _] = parts(&found.format).unwrap_or_default();
    if found.format == FORMAT || major == 1 && !is_earlier {
        return Ok(());
    }
    let format = found.format.clone();
    Err(match is_earlier {
        true => FormatError::Earlier {
            format,
            taceva: found.taceva.clone(),
        },
        false => FormatError::Version { found: format },
    })
}
