//! A fitted model for live predictions.

use std::path::{Path, PathBuf};

use taceva_core::{Channels, Frame, FrameInfo, InputInfo};
use taceva_dataset::Digest;
use taceva_models::{Extractor, Model};

use crate::error::AcquireError;

/// A fitted model and its file, for a [`LivePredictor`](crate::LivePredictor).
#[derive(Clone, Debug)]
pub struct LiveModel {
    model: Model,
    path: PathBuf,
    digest: Digest,
}

impl LiveModel {
    /// Prepares the model read from `path` for camera frames.
    ///
    /// # Errors
    /// [`AcquireError::Model`] if the model does not read frames, or predicts a constant.
    pub fn new(model: Model, path: &Path) -> Result<LiveModel, AcquireError> {
        let refused = |problem: String| AcquireError::Model {
            path: path.to_owned(),
            problem,
        };
        if !model.reads_features() {
            return Err(refused(format!(
                "{} predicts a constant for every picture: fit another model, such as --model ridge",
                model.card().model
            )));
        }
        if let InputInfo::Signals(info) = model.card().input {
            return Err(refused(format!(
                "the model was fitted on signals of taxels, {info}, but a camera gives frames: fit a model on a recording with frames"
            )));
        }
        let digest = model.digest().map_err(|error| refused(error.to_string()))?;
        let digest = digest
            .parse()
            .map_err(|_| refused(format!("invalid digest {digest}")))?;
        Ok(LiveModel {
            model,
            path: path.to_owned(),
            digest,
        })
    }

    /// Name of the model, such as `ridge`.
    pub fn name(&self) -> &str {
        &self.model.card().model
    }

    /// Digest of the model file.
    pub fn digest(&self) -> Digest {
        self.digest
    }

    /// Path of the model file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Channels that the model predicts.
    pub fn channels(&self) -> &Channels {
        self.model.channels()
    }

    /// True if the model computes the distance of a frame from its training data.
    pub fn knows_distance(&self) -> bool {
        self.model.feature_distance().is_some()
    }

    /// True if the model needs a contact-free reference frame.
    pub fn asks_for_reference(&self) -> bool {
        self.model.card().features.asks_for_reference().is_some()
    }

    /// Rejects frames whose size or format differs from the training frames.
    ///
    /// # Errors
    /// [`AcquireError::Model`] with both formats.
    pub fn check(&self, found: FrameInfo) -> Result<(), AcquireError> {
        match self.model.card().input {
            InputInfo::Frame(expected) if expected != found => Err(self.refused(format!(
                "the model was fitted on frames of {expected}, but the camera gives {found}: set the camera to {expected}, or fit a model on a recording of this camera"
            ))),
            _ => Ok(()),
        }
    }

    /// Extractor of the model's features from frames.
    pub(super) fn extractor(
        &self,
        info: FrameInfo,
        reference: Option<&Frame>,
    ) -> Result<Extractor, AcquireError> {
        self.check(info)?;
        let extractor = self.model.extractor(info, reference.map(Into::into));
        extractor.map_err(|error| self.refused(error.to_string()))
    }

    pub(super) fn model(&self) -> &Model {
        &self.model
    }

    pub(super) fn refused(&self, problem: String) -> AcquireError {
        AcquireError::Model {
            path: self.path.clone(),
            problem,
        }
    }
}
