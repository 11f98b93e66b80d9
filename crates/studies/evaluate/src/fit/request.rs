//! Request for a fit.

use taceva_models::{
    ChosenModel, FeatureKinds, FeatureSpec, FeaturesByRecording, ModelEstimator, ModelSettings,
    OpenFeatures,
};

use crate::error::EvaluateError;

/// Request for a fit.
#[derive(Clone, Debug)]
pub struct FitRequest {
    /// Model to fit.
    pub model: ChosenModel,
    /// Settings of the features and of the model.
    pub settings: ModelSettings,
    /// Channels by name; empty for all.
    pub channels: Vec<String>,
    /// Split in text form; `None` for the default split.
    pub split: Option<String>,
    /// Seed of all random draws.
    pub seed: u64,
}

impl FitRequest {
    /// Checks the model and its settings without reading data.
    ///
    /// # Errors
    /// [`EvaluateError`] for an unknown model or setting.
    pub fn check(&self) -> Result<(), EvaluateError> {
        Recipe::of(self).map(drop)
    }

    /// Returns the request with `seed` for the random draws of the model. The division does not change.
    pub fn with_seed(self, seed: u64) -> Result<FitRequest, EvaluateError> {
        const SEED: &str = "seed";
        if !self.model.setting_keys().contains(&SEED) {
            return Err(EvaluateError::Request(format!(
                "the model {} uses no random numbers, so every seed gives the same result: run it without --seeds",
                self.model.name()
            )));
        }
        let others = self.settings.words();
        let others = others.filter(|word| !word.starts_with("seed="));
        let words: Vec<String> = others.chain([format!("{SEED}={seed}")]).collect();
        Ok(FitRequest {
            settings: ModelSettings::parse(words.iter().map(String::as_str))?,
            ..self
        })
    }
}

/// Parsed model and feature settings of a request, before any data is read.
pub struct Recipe {
    pub(super) model: ChosenModel,
    pub(super) estimator: Box<dyn ModelEstimator>,
    pub(super) of_model: ModelSettings,
    pub(super) features: FeatureSpec,
    /// Feature settings that depend on the frames of the recording.
    pub(super) by_recording: FeaturesByRecording,
    /// Requested settings without those in `by_recording`.
    pub(super) asked: ModelSettings,
    /// Feature settings that the fit will choose; `None` if all are known.
    pub(super) open: Option<OpenFeatures>,
    /// Finer features that some candidate models read, if any, with their settings that depend on the frames.
    pub(super) closer: Option<(FeatureSpec, FeaturesByRecording)>,
}

impl Recipe {
    /// Grid cells of a frame that the model reads, along x and y. `None` if the model reads no frames, or if the grid depends on the frames or on a choice.
    pub fn cells(&self) -> Option<[u32; 2]> {
        let FeatureSpec {
            kinds,
            width,
            height,
            ..
        } = self.features;
        let looks = self.model.reads_features() && kinds != FeatureKinds::SIGNALS;
        let is_known = self.open.is_none() && !self.by_recording.leaves_grid();
        (looks && is_known).then_some([width, height])
    }

    /// Parses the settings of the model and of its features.
    pub fn of(request: &FitRequest) -> Result<Recipe, EvaluateError> {
        let model = &request.model;
        let (by_recording, asked) = FeaturesByRecording::of(&request.settings)?;
        let (open, settings) = match OpenFeatures::of(&asked) {
            Some((open, settings)) => (Some(open), settings),
            None => (None, asked.clone()),
        };
        let (of_features, of_model) = settings.partition(FeatureSpec::SETTINGS);
        let mut known = model.setting_keys();
        known.extend(FeatureSpec::SETTINGS.iter().map(|setting| setting.key));
        request.settings.check_names(&known)?;
        let features = model.features().changed_by(&of_features)?;
        // Principal components are computed from a single grid.
        let is_whole = features.pca.is_none() && open.is_none();
        let closer = model.closer_features().filter(|_| is_whole);
        let closer = closer.map(|spec| {
            let by_recording = by_recording.closer(spec, &of_features);
            Ok::<_, EvaluateError>((spec.changed_by(&of_features)?, by_recording))
        });
        Ok(Recipe {
            model: model.clone(),
            estimator: model.estimator(&of_model)?,
            of_model,
            closer: closer.transpose()?,
            by_recording,
            asked,
            features,
            open,
        })
    }
}
