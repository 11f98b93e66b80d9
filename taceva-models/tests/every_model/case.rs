//! Models to test, with the settings of this suite.

use taceva_core::{Features, ModelError, Regressor, SilentProgress};
use taceva_models::{
    FeatureSpec, FitInput, Model, ModelEstimator, ModelFit, ModelSettings, Models, Provenance,
    library_models,
};

use super::cases::{BUILT_IN, LIBRARIES};
use crate::blobs::{BLOB, Blob, Recording};

/// A model with the settings of this suite, and the guarantees specific to this model.
pub(crate) struct Case {
    pub(crate) name: &'static str,
    /// Settings that make the fit fast.
    pub(crate) words: &'static [&'static str],
    /// Minimum number of samples for a fit.
    pub(crate) least: usize,
    /// Largest change of predictions, relative to the largest one, when training samples are reordered. `None` if the order is
    /// drawn at random.
    pub(crate) order: Option<f64>,
    /// True for a deeper form of another model. The other model represents it in tests that fit every model several times.
    pub(crate) deeper: bool,
    /// True if predictions do not depend on the features. A fit is then too short to be cancelled.
    pub(crate) is_constant: bool,
    /// True if principal components may replace pixels.
    pub(crate) components: bool,
    /// Largest root mean square error on the blobs. The labels have a standard deviation of 4.
    pub(crate) error: f64,
    /// Pictures for the fit.
    pub(crate) blob: Blob,
}

/// All cases of this build: built-in models and library models.
pub(crate) fn cases() -> impl Iterator<Item = &'static Case> {
    BUILT_IN.iter().chain(LIBRARIES)
}

pub(crate) const fn case(name: &'static str, words: &'static [&'static str], error: f64) -> Case {
    Case {
        name,
        words,
        least: 2,
        order: Some(1e-9),
        deeper: false,
        is_constant: false,
        components: true,
        error,
        blob: BLOB,
    }
}

pub(crate) fn case_of(name: &str) -> &'static Case {
    cases().find(|case| case.name == name).expect("listed")
}

impl Case {
    /// Models to search. Library models are excluded for a built-in model, because `auto` would try them too.
    pub(crate) fn models(&self) -> Models {
        match self.name.contains('/') {
            false => Models::builtin(),
            true => Models::builtin().with_libraries(library_models()),
        }
    }

    pub(crate) fn recording(&self, samples: usize, seed: u64) -> Recording {
        self.blob.recording(samples, seed)
    }

    pub(crate) fn estimator(&self) -> Box<dyn ModelEstimator> {
        let settings = ModelSettings::parse(self.words.iter().copied()).expect("well formed");
        let model = self.models().find(self.name).expect("registered");
        model.estimator(&settings).expect("valid settings")
    }

    pub(crate) fn fit(
        &self,
        training: &Recording,
        held: Option<&Recording>,
    ) -> Result<ModelFit, ModelError> {
        let held = held.map(Recording::set);
        self.estimator()
            .fit_model(&training.set(), held.as_ref(), &SilentProgress)
    }

    pub(crate) fn fitted(&self, training: &Recording, held: Option<&Recording>) -> ModelFit {
        self.fit(training, held)
            .unwrap_or_else(|error| panic!("{}: {error}", self.name))
    }

    pub(crate) fn refusal(&self, training: &Recording, held: Option<&Recording>) -> String {
        match self.fit(training, held) {
            Ok(_) => panic!("{} accepted what it should refuse", self.name),
            Err(error) => error.to_string(),
        }
    }

    pub(crate) fn model(&self, training: &Recording, pca: Option<u32>) -> Model {
        self.try_model(training, pca)
            .unwrap_or_else(|error| panic!("{}: {error}", self.name))
    }

    pub(crate) fn try_model(
        &self,
        training: &Recording,
        pca: Option<u32>,
    ) -> Result<Model, ModelError> {
        let settings = ModelSettings::parse(self.words.iter().copied()).expect("well formed");
        let estimator = self.estimator();
        let features = FeatureSpec {
            width: u32::try_from(self.blob.shape.width).expect("small"),
            height: u32::try_from(self.blob.shape.height).expect("small"),
            pca,
            ..FeatureSpec::default()
        };
        let input = FitInput {
            estimator: &*estimator,
            settings: &settings,
            features,
            input: self.blob.frame().into(),
            training: training.set(),
            validation: None,
            provenance: Provenance::default(),
        };
        Model::fit(input, &SilentProgress)
    }
}

pub(crate) fn predict(regressor: &dyn Regressor, features: &Features) -> Vec<f64> {
    let mut into = vec![0.0; features.samples() * regressor.channels().len()];
    regressor.predict(features, &mut into).expect("finite");
    into
}

pub(crate) fn bits(values: &[f64]) -> Vec<u64> {
    values.iter().map(|value| value.to_bits()).collect()
}

pub(crate) fn rms(found: &[f64], labels: &[f64]) -> f64 {
    let errors = found.iter().zip(labels).map(|(a, b)| (a - b).powi(2));
    (errors.sum::<f64>() / found.len() as f64).sqrt()
}
