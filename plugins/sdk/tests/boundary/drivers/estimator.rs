//! An estimator that predicts the mean of its training targets.

use taceva_core::{
    ArgSpec, ArgValue, Channels, DriverKey, ErrorKind, FeatureShape, Features, ModelError,
    Regressor, Saved, SavedRegressor,
};
use taceva_plugin::{EstimatorFactory, FitRequest};

pub(super) struct MeanMaker {
    key: DriverKey,
    settings: Vec<ArgSpec>,
}

impl MeanMaker {
    pub(super) fn new() -> MeanMaker {
        MeanMaker {
            key: DriverKey::fixed("org.example.test/mean"),
            settings: vec![ArgSpec::number("shift", -1.0, 1.0).default(ArgValue::Number(0.0))],
        }
    }
}

impl EstimatorFactory for MeanMaker {
    fn key(&self) -> &DriverKey {
        &self.key
    }
    fn title(&self) -> &str {
        "the mean of what was seen"
    }
    fn settings(&self) -> &[ArgSpec] {
        &self.settings
    }
    fn fit(&self, request: &FitRequest<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
        let targets = request.training.targets;
        let columns = targets.channels.len();
        let samples = request.training.features.samples();
        let mut means = vec![request.settings.number("shift"); columns];
        request.progress.begin("add", Some(samples as u64));
        for row in targets.values.chunks_exact(columns) {
            if request.progress.is_cancelled() {
                return Err(ModelError::new(
                    ErrorKind::Interrupted,
                    "the fit was cancelled",
                ));
            }
            for (mean, value) in means.iter_mut().zip(row) {
                let count = samples as f64;
                *mean += value / count;
            }
            request.progress.advance(1);
        }
        Ok(Box::new(Mean {
            channels: targets.channels.clone(),
            shape: request.training.features.shape(),
            means,
        }))
    }
    fn load(&self, saved: &Saved<'_>) -> Result<Box<dyn SavedRegressor>, ModelError> {
        if saved.bytes.len() != 8 * saved.channels.len() {
            return Err(ModelError::new(
                ErrorKind::Protocol,
                "no means of that many channels",
            ));
        }
        let means = saved
            .bytes
            .chunks_exact(8)
            .map(|bytes| f64::from_le_bytes(bytes.try_into().expect("eight")))
            .collect();
        Ok(Box::new(Mean {
            channels: saved.channels.clone(),
            shape: saved.shape,
            means,
        }))
    }
}

struct Mean {
    channels: Channels,
    shape: FeatureShape,
    means: Vec<f64>,
}

impl Regressor for Mean {
    fn channels(&self) -> &Channels {
        &self.channels
    }
    fn shape(&self) -> FeatureShape {
        self.shape
    }
    fn predict(&self, _: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        for row in into.chunks_exact_mut(self.means.len()) {
            row.copy_from_slice(&self.means);
        }
        Ok(())
    }
}

impl SavedRegressor for Mean {
    fn save(&self) -> Result<Vec<u8>, ModelError> {
        Ok(self
            .means
            .iter()
            .flat_map(|mean| mean.to_le_bytes())
            .collect())
    }
}
