//! A fit that chooses among models of which some see finer features.

use taceva_core::{Features, ModelError, Progress};

use super::{FitInput, Model, with_features};
use crate::features::FeatureSpec;
use crate::linalg::invalid;

/// Finer features of the samples of a fit.
#[derive(Clone, Copy, Debug)]
pub struct CloserFeatures<'a> {
    /// What they are.
    pub spec: FeatureSpec,
    /// Of the training part, sample by sample.
    pub training: &'a Features,
    /// Of the validation part, where there is one.
    pub validation: Option<&'a Features>,
}

impl Model {
    /// As [`fit`](Model::fit), with finer features too for what [looks closer](crate::ModelEstimator::looks_closer): the model is the one that fitting
    /// what was chosen, on the features that it sees, gives.
    ///
    /// # Errors
    /// As [`fit`](Model::fit), and if there are finer features of the one part alone.
    pub fn fit_closer(
        input: FitInput<'_>,
        closer: CloserFeatures<'_>,
        progress: &dyn Progress,
    ) -> Result<Model, ModelError> {
        if input.validation.is_some() != closer.validation.is_some() {
            return Err(invalid(
                "finer features of the training part, or of the validation part, alone",
            ));
        }
        let chosen = input
            .estimator
            .choose(&input.training, Some(closer.training), progress)?;
        let Some(chosen) = chosen else {
            return Model::fit(input, progress);
        };
        let coarse = FitInput {
            estimator: &*chosen.estimator,
            ..input
        };
        let input = match chosen.is_closer {
            false => coarse,
            true => FitInput {
                features: closer.spec,
                training: with_features(coarse.training, Some(closer.training)),
                validation: coarse
                    .validation
                    .map(|set| with_features(set, closer.validation)),
                ..coarse
            },
        };
        let mut model = Model::fit(input, progress)?;
        model.card.auto = Some(chosen.card);
        Ok(model)
    }
}
