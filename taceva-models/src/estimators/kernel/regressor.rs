//! Fitted kernel models: linear functions of Nyström features.

use rayon::prelude::*;
use taceva_core::{Channels, FeatureShape, Features, ModelError, Regressor};

use super::nystrom::Nystrom;
use super::uncertainty::Uncertainty;
use crate::estimators::linear::LinearRegressor;
use crate::linalg::standard::Standard;
use crate::training::card::{Form, KindCard};
use crate::training::file::content::Stored;
use crate::training::file::error::FormatError;
use crate::training::file::tensors::{Raw, Tensors};
use crate::training::output::{check_call, check_finite};
use crate::training::regressor::{FittedModel, ModelRegressor};

/// A fitted kernel model.
#[derive(Clone, Debug, PartialEq)]
pub struct KernelRegressor {
    shape: FeatureShape,
    map: Nystrom,
    linear: LinearRegressor,
    uncertainty: Option<Uncertainty>,
}

/// Number of samples per task of a thread.
const CHUNK: usize = 8;

const CENTRE: &str = "kernel.centre";
const FACTOR: &str = "kernel.factor";
const ROWS: &str = "kernel.landmarks";
const TRIANGLE: &str = "kernel.triangle";
const RATE: &str = "kernel.rate";
const WEIGHTS: &str = "weights";
const BIAS: &str = "bias";

impl KernelRegressor {
    pub(super) fn new(
        shape: FeatureShape,
        map: Nystrom,
        linear: LinearRegressor,
        uncertainty: Option<Uncertainty>,
    ) -> KernelRegressor {
        KernelRegressor {
            shape,
            map,
            linear,
            uncertainty,
        }
    }

    /// Number of landmarks.
    pub fn landmarks(&self) -> usize {
        self.map.len()
    }

    /// Kernel length ℓ, relative to the root mean square distance of a training sample from the mean.
    pub fn length(&self) -> f64 {
        self.map.length
    }

    fn for_each(
        &self,
        features: &Features,
        into: &mut [f64],
        write: impl Fn(&[f32], &mut [f64]) + Sync,
    ) {
        let (width, channels) = (self.shape.len(), self.channels().len());
        into.par_chunks_mut(CHUNK * channels)
            .zip(features.values().par_chunks(CHUNK * width))
            .for_each(|(into, samples)| {
                let samples = samples.chunks_exact(width);
                for (into, sample) in into.chunks_exact_mut(channels).zip(samples) {
                    write(&self.map.of_one(sample), into);
                }
            });
    }

    /// Loads the model from a file.
    pub(crate) fn load(stored: &Stored<'_>) -> Result<ModelRegressor, FormatError> {
        stored.on_components(KernelRegressor::from_tensors)
    }

    /// Builds the model from the tensors of a file.
    fn from_tensors(
        tensors: &Tensors<'_>,
        channels: Channels,
        shape: FeatureShape,
    ) -> Result<KernelRegressor, FormatError> {
        let width = shape.len();
        let count = tensors.rows(ROWS)?;
        let standard = Standard::new(
            tensors.doubles(CENTRE, &[width])?,
            tensors.doubles(FACTOR, &[width])?,
        )?;
        let numbers = tensors.doubles(RATE, &[2])?;
        let triangle = count
            .checked_add(1)
            .and_then(|next| next.checked_mul(count));
        let factor = tensors.doubles(TRIANGLE, &[triangle.ok_or(FormatError::Card)? / 2])?;
        let rows = tensors.singles(ROWS, &[count, width])?;
        let diagonal = (0..count).map(|row| factor[(row + 1) * (row + 2) / 2 - 1]);
        let finite = factor.iter().chain(&numbers).all(|value| value.is_finite())
            && rows.iter().all(|value| value.is_finite());
        if count == 0 || !finite || !diagonal.chain(numbers.iter().copied()).all(|v| v > 0.0) {
            return Err(FormatError::Card);
        }
        let weights = tensors.doubles(WEIGHTS, &[channels.len(), count])?;
        let bias = tensors.doubles(BIAS, &[channels.len()])?;
        let known = channels.len();
        Ok(KernelRegressor {
            shape,
            map: Nystrom::ready(standard, numbers[0], numbers[1], rows, factor),
            linear: LinearRegressor::new(channels, FeatureShape::flat(count), weights, bias)?,
            uncertainty: Uncertainty::from_tensors(tensors, count, known)?,
        })
    }
}

impl FittedModel for KernelRegressor {
    fn kind(&self) -> KindCard {
        KindCard::from(Form::Kernel {
            landmarks: self.landmarks(),
            length: self.length(),
            deviations: self.knows_deviations(),
        })
    }

    fn tensors(&self) -> Vec<Raw> {
        let (count, width) = (self.map.len(), self.shape.len());
        let channels = self.channels().len();
        let own = [
            Raw::doubles(BIAS, vec![channels], self.linear.bias()),
            Raw::doubles(CENTRE, vec![width], self.map.standard.centre()),
            Raw::doubles(FACTOR, vec![width], self.map.standard.factor()),
            Raw::singles(ROWS, vec![count, width], &self.map.rows),
            Raw::doubles(RATE, vec![2], &[self.map.length, self.map.rate]),
            Raw::doubles(TRIANGLE, vec![self.map.factor.len()], &self.map.factor),
            Raw::doubles(WEIGHTS, vec![channels, count], self.linear.weights()),
        ];
        let known = self.uncertainty.iter().flat_map(Uncertainty::tensors);
        own.into_iter().chain(known).collect()
    }

    fn reads_features(&self) -> bool {
        let mut weights = self.linear.weights().iter();
        weights.any(|weight| weight.abs() > 0.0)
    }

    fn knows_deviations(&self) -> bool {
        self.uncertainty.is_some()
    }

    fn deviations(&self, features: &Features) -> Result<Option<Vec<f64>>, ModelError> {
        let mut into = vec![0.0; features.samples() * self.channels().len()];
        check_call(self.channels(), self.shape, features, &into)?;
        let Some(uncertainty) = &self.uncertainty else {
            return Ok(None);
        };
        self.for_each(features, &mut into, |mapped, into| {
            uncertainty.write(mapped, into);
        });
        check_finite(self.channels(), &into)?;
        Ok(Some(into))
    }
}

impl Regressor for KernelRegressor {
    fn channels(&self) -> &Channels {
        self.linear.channels()
    }

    fn shape(&self) -> FeatureShape {
        self.shape
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        check_call(self.channels(), self.shape, features, into)?;
        self.for_each(features, into, |mapped, into| {
            self.linear.write(mapped, into);
        });
        check_finite(self.channels(), into)
    }
}
