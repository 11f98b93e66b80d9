//! What tells the spacing of gratings, made ready from what a scene says.

use taceva_models::{FeatureSpec, NetworkEstimator, SpacingOutput};
use taceva_protocol::{GratingTeller, Gratings};

use crate::error::StudyError;
use crate::scene::settings_of;

/// What tells the spacing of gratings.
#[derive(Debug)]
pub(crate) enum Teller {
    /// Linear discriminants of the radial spectrum.
    Spectrum,
    /// A network.
    Network(Box<NetworkTeller>),
}

/// A network that tells the spacing of gratings, not fitted yet.
#[derive(Debug)]
pub(crate) struct NetworkTeller {
    pub(crate) estimator: NetworkEstimator,
    /// What it sees of a picture.
    pub(crate) features: FeatureSpec,
    pub(crate) output: SpacingOutput,
}

impl Teller {
    /// The teller that `spec` asks for.
    ///
    /// # Errors
    /// [`StudyError`] for a setting that it does not take.
    pub(crate) fn of(spec: &Gratings) -> Result<Teller, StudyError> {
        let settings = settings_of(&spec.set.value)?;
        let output = match spec.told_by.value {
            GratingTeller::Spectrum => {
                settings.check_keys(&[])?;
                return Ok(Teller::Spectrum);
            }
            GratingTeller::Cnn => SpacingOutput::Classes,
            GratingTeller::CnnLength => SpacingOutput::Length,
        };
        let (of_features, of_model) = settings.partition(FeatureSpec::SETTINGS);
        Ok(Teller::Network(Box::new(NetworkTeller {
            estimator: NetworkEstimator::cnn(&of_model)?,
            features: NetworkEstimator::CNN
                .features
                .unwrap_or_default()
                .changed_by(&of_features)?,
            output,
        })))
    }

    /// What a reader must know of how spacings were told.
    pub(crate) const fn note(&self) -> &'static str {
        match self {
            Teller::Spectrum => {
                "sr: spacings are told from the radial spectrum of what a picture shows beyond the mean picture, by linear \
                 discriminants, lines and dots apart, fitted on the other two thirds of the presses of every board"
            }
            Teller::Network(_) => {
                "sr: spacings are told by a convolutional network, lines and dots apart, fitted on the other two thirds of the \
                 presses of every board"
            }
        }
    }
}
