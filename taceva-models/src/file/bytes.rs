//! Models as bytes in the safetensors format, with the model card in the metadata.

use std::collections::HashMap;

use safetensors::tensor::TensorView;

use super::distance::distance_tensors;
use super::seal::{digested, seal_over};
use crate::model::Model;
use crate::models::Models;
use crate::training::file::error::FormatError;
use crate::training::file::limits::{CARD, FILE_MAX, HEADER_MAX};

impl Model {
    /// Serialises the model. Equal models give equal bytes.
    ///
    /// # Errors
    /// [`FormatError`] if the card or the weights exceed the size limits of a file.
    pub fn to_bytes(&self) -> Result<Vec<u8>, FormatError> {
        let card = serde_json::to_string(&self.card)?;
        let mut tensors = self.regressor.tensors();
        tensors.extend(self.distance.iter().flat_map(distance_tensors));
        let digested = tensors
            .iter()
            .map(|tensor| digested(&tensor.name, tensor.kind, &tensor.shape, &tensor.bytes));
        let card = seal_over(&card, &digested.collect::<Vec<_>>())?;
        // Only one key, because the order of several keys is undefined.
        let metadata = HashMap::from([(CARD.to_owned(), card)]);
        let views: Result<Vec<_>, _> = tensors
            .iter()
            .map(|tensor| {
                let view = TensorView::new(tensor.kind, tensor.shape.clone(), &tensor.bytes);
                view.map(|view| (tensor.name.as_str(), view))
            })
            .collect();
        let bytes = safetensors::serialize(views?, Some(metadata))?;
        check_sizes(&bytes)?;
        Ok(bytes)
    }

    /// Reads a model from `bytes`. Only built-in models are accepted.
    ///
    /// # Errors
    /// Errors of [`Models::read`].
    pub fn from_bytes(bytes: &[u8]) -> Result<Model, FormatError> {
        Models::builtin().read(bytes)
    }
}

/// Rejects bytes that exceed the size limits of a file or its header.
pub(super) fn check_sizes(bytes: &[u8]) -> Result<(), FormatError> {
    let length = bytes.len() as u64;
    if length > FILE_MAX {
        return Err(FormatError::FileSize { length });
    }
    let length = bytes.first_chunk::<8>().ok_or(FormatError::Short)?;
    let length = u64::from_le_bytes(*length);
    if length > HEADER_MAX {
        return Err(FormatError::HeaderSize { length });
    }
    Ok(())
}
