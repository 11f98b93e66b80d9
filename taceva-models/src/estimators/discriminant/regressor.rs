//! Classification by linear functions: predicts the label whose function has the greatest value for the features.

use rayon::prelude::*;
use taceva_core::{Channels, FeatureShape, Features, ModelError, Regressor};

use crate::linalg::Design;
use crate::training::card::{Form, KindCard};
use crate::training::file::content::Stored;
use crate::training::file::error::FormatError;
use crate::training::file::tensors::{Raw, Tensors};
use crate::training::output::{check_call, check_finite};
use crate::training::regressor::{FittedModel, ModelRegressor};

/// Linear functions of the raw features for one channel, one function per label.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Planes {
    /// Label of each function, in the unit of the channel.
    values: Vec<f64>,
    /// Weights of the functions, shape `[labels, features]`.
    weights: Vec<f64>,
    offsets: Vec<f64>,
}

impl Planes {
    /// Converts functions of the standardised features of `design` to functions of raw features.
    pub(super) fn new(
        values: Vec<f64>,
        planes: Vec<(Vec<f64>, f64)>,
        design: &Design<'_>,
    ) -> Planes {
        let (mut weights, mut offsets) = (Vec::new(), Vec::new());
        for (mut plane, mut offset) in planes {
            if let Some(factor) = design.factor() {
                let own = plane.iter_mut().zip(factor);
                own.for_each(|(weight, factor)| *weight *= factor);
            }
            let shift = plane.iter().zip(design.centre());
            offset -= shift.map(|(weight, centre)| weight * centre).sum::<f64>();
            weights.extend(plane);
            offsets.push(offset);
        }
        Planes {
            values,
            weights,
            offsets,
        }
    }

    /// Label whose function is greatest for the features `sample`. Of equal functions, the first label.
    fn class(&self, sample: &[f32]) -> f64 {
        let mut best = (f64::NEG_INFINITY, f64::NAN);
        let planes = self.weights.chunks_exact(sample.len()).zip(&self.offsets);
        for ((weights, offset), &value) in planes.zip(&self.values) {
            let products = weights.iter().zip(sample);
            let height = products
                .map(|(weight, &x)| weight * f64::from(x))
                .sum::<f64>()
                + offset;
            if height > best.0 {
                best = (height, value);
            }
        }
        best.1
    }
}

/// Fitted classifier that predicts each channel as one of its training labels.
#[derive(Clone, Debug, PartialEq)]
pub struct ClassRegressor {
    channels: Channels,
    shape: FeatureShape,
    planes: Vec<Planes>,
}

const COUNTS: &str = "classes.counts";
const OFFSETS: &str = "classes.offsets";
const VALUES: &str = "classes.values";
const WEIGHTS: &str = "classes.weights";

impl ClassRegressor {
    pub(super) fn new(
        channels: Channels,
        shape: FeatureShape,
        planes: Vec<Planes>,
    ) -> ClassRegressor {
        ClassRegressor {
            channels,
            shape,
            planes,
        }
    }

    /// Total number of classes over all channels.
    pub fn classes(&self) -> usize {
        self.planes.iter().map(|planes| planes.values.len()).sum()
    }

    /// Loads the model from a file.
    pub(crate) fn load(stored: &Stored<'_>) -> Result<ModelRegressor, FormatError> {
        stored.on_components(ClassRegressor::from_tensors)
    }

    /// Builds the model from the tensors of a file.
    fn from_tensors(
        tensors: &Tensors<'_>,
        channels: Channels,
        shape: FeatureShape,
    ) -> Result<ClassRegressor, FormatError> {
        let (classes, width) = (tensors.rows(WEIGHTS)?, shape.len());
        let counts = tensors.integers(COUNTS, &[channels.len()])?;
        let offsets = tensors.doubles(OFFSETS, &[classes])?;
        let values = tensors.doubles(VALUES, &[classes])?;
        let weights = tensors.doubles(WEIGHTS, &[classes, width])?;
        let total: u64 = counts.iter().map(|&count| u64::from(count)).sum();
        let mut numbers = offsets.iter().chain(&values).chain(&weights);
        let is_whole = total == classes as u64 && counts.iter().all(|&count| count > 0);
        if !is_whole || !numbers.all(|value| value.is_finite()) {
            return Err(FormatError::Card);
        }
        let mut start = 0;
        let planes = counts.into_iter().map(|count| {
            let own = start..start + count as usize;
            start = own.end;
            Planes {
                values: values[own.clone()].to_vec(),
                weights: weights[own.start * width..own.end * width].to_vec(),
                offsets: offsets[own].to_vec(),
            }
        });
        Ok(ClassRegressor::new(channels, shape, planes.collect()))
    }
}

impl FittedModel for ClassRegressor {
    fn kind(&self) -> KindCard {
        KindCard::from(Form::Classes {
            classes: self.classes(),
        })
    }

    fn tensors(&self) -> Vec<Raw> {
        let joined = |part: fn(&Planes) -> &Vec<f64>| -> Vec<f64> {
            self.planes.iter().flat_map(part).copied().collect()
        };
        let counts: Vec<u32> = self
            .planes
            .iter()
            .map(|planes| u32::try_from(planes.values.len()).expect("a few hundred"))
            .collect();
        let (classes, width) = (self.classes(), self.shape.len());
        vec![
            Raw::integers(COUNTS, vec![counts.len()], &counts),
            Raw::doubles(OFFSETS, vec![classes], &joined(|planes| &planes.offsets)),
            Raw::doubles(VALUES, vec![classes], &joined(|planes| &planes.values)),
            Raw::doubles(
                WEIGHTS,
                vec![classes, width],
                &joined(|planes| &planes.weights),
            ),
        ]
    }

    fn reads_features(&self) -> bool {
        let mut weights = self.planes.iter().flat_map(|planes| &planes.weights);
        weights.any(|weight| weight.abs() > 0.0)
    }
}

impl Regressor for ClassRegressor {
    fn channels(&self) -> &Channels {
        &self.channels
    }

    fn shape(&self) -> FeatureShape {
        self.shape
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        check_call(&self.channels, self.shape, features, into)?;
        into.par_chunks_mut(self.channels.len())
            .zip(features.values().par_chunks(self.shape.len()))
            .for_each(|(into, sample)| {
                for (place, planes) in into.iter_mut().zip(&self.planes) {
                    *place = planes.class(sample);
                }
            });
        check_finite(&self.channels, into)
    }
}
