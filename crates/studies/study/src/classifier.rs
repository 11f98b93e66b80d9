//! Classifier of grating spacings, configured from a scene.

use taceva_models::{
    ChosenModel, FeatureSpec, ModelSettings, Models, NetworkEstimator, SpacingOutput,
};
use taceva_protocol::{GratingClassifier, Gratings};

use taceva_evaluate::EvaluateError;

use crate::settings::settings_of;

/// A classifier of grating spacings.
#[derive(Debug)]
pub(crate) enum SpacingClassifier {
    /// Linear discriminant analysis of the radial spectrum of a frame.
    Spectrum,
    /// A model that reads the radial spectrum of a frame and predicts one of its training labels.
    Model(Box<ModelClassifier>),
    Network(Box<NetworkClassifier>),
}

/// Settings of a model that will be fitted to radial spectra of frames.
#[derive(Debug)]
pub(crate) struct ModelClassifier {
    pub(crate) model: ChosenModel,
    pub(crate) settings: ModelSettings,
}

/// Settings of a network that will be fitted to classify grating spacings.
#[derive(Debug)]
pub(crate) struct NetworkClassifier {
    pub(crate) estimator: NetworkEstimator,
    /// Features computed from a frame.
    pub(crate) features: FeatureSpec,
    pub(crate) output: SpacingOutput,
}

impl SpacingClassifier {
    /// Creates the classifier that `spec` requests.
    ///
    /// # Errors
    /// [`EvaluateError`] for an unknown setting, or a model that is not among `models`.
    pub(crate) fn of(spec: &Gratings, models: &Models) -> Result<SpacingClassifier, EvaluateError> {
        let settings = settings_of(&spec.set.value)?;
        let output = match spec.classified_by.value {
            GratingClassifier::Spectrum => {
                settings.check_keys(&[])?;
                return Ok(SpacingClassifier::Spectrum);
            }
            GratingClassifier::LinfaLogistic => {
                let model = models.find("linfa/logistic")?;
                model.estimator(&settings)?;
                return Ok(SpacingClassifier::Model(Box::new(ModelClassifier {
                    model,
                    settings,
                })));
            }
            GratingClassifier::Cnn => SpacingOutput::Classes,
            GratingClassifier::CnnLength => SpacingOutput::Length,
        };
        let (of_features, of_model) = settings.partition(FeatureSpec::SETTINGS);
        Ok(SpacingClassifier::Network(Box::new(NetworkClassifier {
            estimator: NetworkEstimator::cnn(&of_model)?,
            features: NetworkEstimator::CNN
                .features
                .unwrap_or_default()
                .changed_by(&of_features)?,
            output,
        })))
    }

    /// Grid cells of a frame that the classifier reads, along x and y; `None` if it reads the whole frame.
    pub(crate) fn cells(&self) -> Option<[u32; 2]> {
        match self {
            SpacingClassifier::Network(network) => {
                Some([network.features.width, network.features.height])
            }
            SpacingClassifier::Spectrum | SpacingClassifier::Model(_) => None,
        }
    }

    /// Description of the prediction method, for the report.
    pub(crate) const fn note(&self) -> &'static str {
        match self {
            SpacingClassifier::Spectrum => {
                "sr: spacings are predicted from the radial spectrum of each picture minus the mean picture, by linear discriminants. Lines and dots are fitted separately, on the other two thirds of the presses of every board. Each answer is the spacing of one of these boards"
            }
            SpacingClassifier::Model(_) => {
                "sr: spacings are predicted from the radial spectrum of each picture minus the mean picture, by multinomial logistic regression of linfa. Lines and dots are fitted separately, on the other two thirds of the presses of every board. Each answer is the spacing of one of these boards"
            }
            SpacingClassifier::Network(_) => {
                "sr: spacings are predicted by a convolutional network. Lines and dots are fitted separately, on the other two thirds of the presses of every board. Each answer is the spacing of one of these boards"
            }
        }
    }
}
