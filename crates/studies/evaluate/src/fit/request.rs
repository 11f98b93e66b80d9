//! What is to be fitted, before any data is looked at.

use taceva_models::{
    ChosenModel, FeatureKinds, FeatureSpec, FeaturesByRecording, ModelEstimator, ModelSettings,
    OpenFeatures,
};

use crate::error::EvaluateError;

/// What to fit.
#[derive(Clone, Debug)]
pub struct FitRequest {
    /// The model.
    pub model: ChosenModel,
    /// Settings of its features and of itself.
    pub settings: ModelSettings,
    /// Channels by name; empty for all.
    pub channels: Vec<String>,
    /// The split as people write it; by point where points have repeats, else random, if `None`.
    pub split: Option<String>,
    /// The seed of everything that is drawn.
    pub seed: u64,
}

impl FitRequest {
    /// Whether its model and settings are valid; no data is read.
    ///
    /// # Errors
    /// [`EvaluateError`] for a model that does not exist, or a setting that it does not have.
    pub fn check(&self) -> Result<(), EvaluateError> {
        Recipe::of(self).map(drop)
    }

    /// The same with `seed` for whatever the model draws; division and everything else stays.
    pub fn with_seed(self, seed: u64) -> Result<FitRequest, EvaluateError> {
        const SEED: &str = "seed";
        if !self.model.setting_keys().contains(&SEED) {
            return Err(EvaluateError::Request(format!(
                "the model {} draws nothing: with every seed it would be the same, so run it without --seeds",
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

/// What a request asks for, before any data is looked at.
pub struct Recipe {
    pub(super) model: ChosenModel,
    pub(super) estimator: Box<dyn ModelEstimator>,
    pub(super) of_model: ModelSettings,
    pub(super) features: FeatureSpec,
    /// What of them is left to the frames of the recording.
    pub(super) by_recording: FeaturesByRecording,
    /// The settings without what is left to the frames.
    pub(super) asked: ModelSettings,
    /// What of the features is to be chosen.
    pub(super) open: Option<OpenFeatures>,
    /// Finer features that some of the models see that are chosen from, and what of these is left to the frames.
    pub(super) closer: Option<(FeatureSpec, FeaturesByRecording)>,
}

impl Recipe {
    /// The cells of a frame that the model looks at, along x and y; `None` where it looks at none, or the frames or a choice
    /// decide.
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

    /// Reads the settings of the model and of its features.
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
        // Components are of one grid.
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
