//! Nearest-neighbour models: store the training samples and predict a weighted mean of their labels.

use faer::Mat;
use rayon::prelude::*;
use taceva_core::{Channels, FeatureShape, Features, ModelError, Regressor};

use crate::linalg::distance::squared_distance;
use crate::linalg::standard::Standard;
use crate::training::card::{Form, KindCard};
use crate::training::file::content::Stored;
use crate::training::file::error::FormatError;
use crate::training::file::tensors::{Raw, Tensors};
use crate::training::output::{OutputScale, check_call, check_finite};
use crate::training::regressor::{FittedModel, ModelRegressor};

/// Training samples with their labels, and the number of neighbours that each channel uses.
#[derive(Clone, Debug, PartialEq)]
pub struct NeighbourRegressor {
    channels: Channels,
    shape: FeatureShape,
    standard: Standard,
    /// Standardised features of the training samples, shape `[samples, features]`.
    rows: Vec<f32>,
    /// Labels, divided by their range and centred, shape `[samples, channels]`.
    labels: Vec<f64>,
    scale: OutputScale,
    counts: Vec<usize>,
}

const CENTRE: &str = "neighbours.centre";
const COUNTS: &str = "neighbours.counts";
const FACTOR: &str = "neighbours.factor";
const LABELS: &str = "neighbours.labels";
const OFFSET: &str = "neighbours.offset";
const ROWS: &str = "neighbours.samples";
const SPAN: &str = "neighbours.span";

/// A training sample, with its squared distance from the sample to predict.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    distance: f32,
    sample: usize,
}

/// Finds the `count` rows nearest to `sample`, and all other rows at the greatest of these distances. Sorted by distance.
pub(super) fn nearest(sample: &[f32], rows: &[f32], count: usize) -> Vec<Near> {
    let rows = rows.chunks_exact(sample.len()).enumerate();
    let mut all: Vec<Near> = rows
        .map(|(position, row)| Near {
            distance: squared_distance(sample, row),
            sample: position,
        })
        .collect();
    let order = |a: &Near, b: &Near| {
        a.distance
            .total_cmp(&b.distance)
            .then(a.sample.cmp(&b.sample))
    };
    if count < all.len() {
        let (_, last, _) = all.select_nth_unstable_by(count - 1, order);
        let farthest = last.distance;
        all.retain(|near| near.distance <= farthest);
    }
    all.sort_unstable_by(order);
    all
}

/// Mean of `label` over the first `count` samples of `near`, weighted by 1 / distance. Includes all other samples at the greatest of these distances.
pub(super) fn weighted(near: &[Near], count: usize, label: impl Fn(usize) -> f64) -> f64 {
    let farthest = near[count.min(near.len()) - 1].distance;
    let inside = near.iter().take_while(|near| near.distance <= farthest);
    let equal = near.first().is_some_and(|first| first.distance <= 0.0);
    let (mut sum, mut weights) = (0.0, 0.0);
    for near in inside.take_while(|near| !equal || near.distance <= 0.0) {
        let weight = if equal {
            1.0
        } else {
            1.0 / f64::from(near.distance).sqrt()
        };
        sum += weight * label(near.sample);
        weights += weight;
    }
    sum / weights
}

impl NeighbourRegressor {
    pub(super) fn new(
        channels: Channels,
        shape: FeatureShape,
        rows: Vec<f32>,
        standard: Standard,
        labels: &Mat<f64>,
        scale: OutputScale,
        counts: Vec<usize>,
    ) -> NeighbourRegressor {
        let places = (0..labels.nrows()).flat_map(|row| (0..labels.ncols()).map(move |c| (row, c)));
        NeighbourRegressor {
            channels,
            shape,
            standard,
            rows,
            labels: places.map(|place| labels[place]).collect(),
            scale,
            counts,
        }
    }

    /// Number of stored training samples.
    pub fn samples(&self) -> usize {
        self.labels.len() / self.channels.len()
    }

    /// Loads the model from a file.
    pub(crate) fn load(stored: &Stored<'_>) -> Result<ModelRegressor, FormatError> {
        stored.on_components(NeighbourRegressor::from_tensors)
    }

    /// Builds the model from the tensors of a file.
    fn from_tensors(
        tensors: &Tensors<'_>,
        channels: Channels,
        shape: FeatureShape,
    ) -> Result<NeighbourRegressor, FormatError> {
        let samples = tensors.rows(ROWS)?;
        let (width, count) = (shape.len(), channels.len());
        let found = NeighbourRegressor {
            standard: Standard::new(
                tensors.doubles(CENTRE, &[width])?,
                tensors.doubles(FACTOR, &[width])?,
            )?,
            rows: tensors.singles(ROWS, &[samples, width])?,
            labels: tensors.doubles(LABELS, &[samples, count])?,
            scale: OutputScale {
                offset: tensors.doubles(OFFSET, &[count])?,
                span: tensors.doubles(SPAN, &[count])?,
            },
            counts: tensors
                .integers(COUNTS, &[count])?
                .into_iter()
                .map(|count| count as usize)
                .collect(),
            channels,
            shape,
        };
        let finite = found.labels.iter().all(|value| value.is_finite())
            && found.rows.iter().all(|value| value.is_finite());
        let counted = found.counts.iter().all(|count| (1..=1000).contains(count));
        if samples > 0 && finite && counted && found.scale.is_valid(count) {
            Ok(found)
        } else {
            Err(FormatError::Card)
        }
    }
}

impl FittedModel for NeighbourRegressor {
    fn kind(&self) -> KindCard {
        KindCard::from(Form::Neighbours {
            samples: self.samples(),
        })
    }

    fn tensors(&self) -> Vec<Raw> {
        let (samples, width, channels) = (self.samples(), self.shape.len(), self.channels.len());
        let counts: Vec<u32> = self
            .counts
            .iter()
            .map(|&count| u32::try_from(count).expect("at most a thousand"))
            .collect();
        vec![
            Raw::doubles(CENTRE, vec![width], self.standard.centre()),
            Raw::integers(COUNTS, vec![channels], &counts),
            Raw::doubles(FACTOR, vec![width], self.standard.factor()),
            Raw::doubles(LABELS, vec![samples, channels], &self.labels),
            Raw::doubles(OFFSET, vec![channels], &self.scale.offset),
            Raw::singles(ROWS, vec![samples, width], &self.rows),
            Raw::doubles(SPAN, vec![channels], &self.scale.span),
        ]
    }

    fn reads_features(&self) -> bool {
        self.labels.iter().any(|label| label.abs() > 0.0)
    }
}

impl Regressor for NeighbourRegressor {
    fn channels(&self) -> &Channels {
        &self.channels
    }

    fn shape(&self) -> FeatureShape {
        self.shape
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        check_call(&self.channels, self.shape, features, into)?;
        let channels = self.channels.len();
        let most = self.counts.iter().copied().max().unwrap_or(1);
        into.par_chunks_mut(channels)
            .zip(features.values().par_chunks(self.shape.len()))
            .for_each(|(into, sample)| {
                let mut own = vec![0.0; sample.len()];
                self.standard.write(sample, &mut own);
                let near = nearest(&own, &self.rows, most);
                for (channel, place) in into.iter_mut().enumerate() {
                    let label = |sample: usize| self.labels[sample * channels + channel];
                    *place = weighted(&near, self.counts[channel], label);
                }
                self.scale.unscale(into);
            });
        check_finite(&self.channels, into)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_samples_count_alone_and_ties_count_together() {
        let rows = [0.0, 1.0, 3.0, -3.0, 1.0];
        let labels = [10.0, 2.0, 8.0, 6.0, 4.0];
        let label = |sample: usize| labels[sample];
        // 1.0 occurs twice.
        let near = nearest(&[1.0], &rows, 3);
        assert!((weighted(&near, 3, label) - 3.0).abs() < 1e-15);
        // From 0.5: 0.0, 1.0 and 1.0 are all 0.5 away.
        let near = nearest(&[0.5], &rows, 1);
        assert!((weighted(&near, 1, label) - 16.0 / 3.0).abs() < 1e-14);
        // 3.0 is 2.5 away; its weight is a fifth of the others.
        let near = nearest(&[0.5], &rows, 4);
        assert!((weighted(&near, 4, label) - (16.0 + 8.0 / 5.0) / 3.2).abs() < 1e-14);
    }
}
