//! Fits that choose among models, some of which use finer features.

use taceva_core::{Features, ModelError, Progress};

use super::{FitInput, Model, with_features};
use crate::features::FeatureSpec;
use crate::linalg::invalid;

/// Features on a finer grid, for the samples of a fit.
#[derive(Clone, Copy, Debug)]
pub struct CloserFeatures<'a> {
    /// Specification of the features.
    pub spec: FeatureSpec,
    /// Features of the training part, by sample.
    pub training: &'a Features,
    /// Features of the validation part, if it exists.
    pub validation: Option<&'a Features>,
}

impl Model {
    /// Chooses an estimator and fits it like [`fit`](Model::fit). An estimator that [looks closer](crate::ModelEstimator::looks_closer) gets the
    /// features of `closer`, any other the features of `input`.
    ///
    /// # Errors
    /// Errors of [`fit`](Model::fit), and [`ModelError`] if only one of `input` and `closer` has a validation part.
    pub fn fit_closer(
        input: FitInput<'_>,
        closer: CloserFeatures<'_>,
        progress: &dyn Progress,
    ) -> Result<Model, ModelError> {
        if input.validation.is_some() != closer.validation.is_some() {
            return Err(invalid(
                "only the input or only its finer features have a validation part, expected both or neither",
            ));
        }
        let chosen =
            input
                .estimator
                .choose(&input.training, None, Some(closer.training), progress)?;
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
