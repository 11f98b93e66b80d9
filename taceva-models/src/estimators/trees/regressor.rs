//! Fitted forests and boosted trees. Their prediction is the sum over trees.

use rayon::prelude::*;
use taceva_core::{Channels, FeatureShape, Features, ModelError, Regressor};

use super::grow::Tree;
use crate::training::card::{Form, KindCard};
use crate::training::file::content::Stored;
use crate::training::file::error::FormatError;
use crate::training::file::tensors::{Raw, Tensors};
use crate::training::output::{OutputScale, check_call, check_finite};
use crate::training::regressor::{FittedModel, ModelRegressor};

/// Fitted model whose prediction is the sum of its trees. Each tree predicts one channel or all channels.
#[derive(Clone, Debug, PartialEq)]
pub struct TreeRegressor {
    channels: Channels,
    shape: FeatureShape,
    scale: OutputScale,
    trees: Vec<Member>,
}

/// One tree of a model, and the channel that it predicts.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Member {
    pub(super) tree: Tree,
    /// Channel that the tree predicts; `None` for all channels.
    pub(super) channel: Option<usize>,
}

/// Number of samples that one parallel task predicts.
const CHUNK: usize = 64;

/// Channel number in model files for a tree that predicts all channels.
const ALL: u32 = u32::MAX;

const CHANNEL: &str = "trees.channel";
const FEATURE: &str = "trees.feature";
const LEFT: &str = "trees.left";
const OFFSET: &str = "trees.offset";
const SIZE: &str = "trees.size";
const SPAN: &str = "trees.span";
const THRESHOLD: &str = "trees.threshold";
const VALUES: &str = "trees.values";

impl TreeRegressor {
    /// Builds a regressor from its trees. The trees predict scaled labels minus their mean; `scale` converts their sum to labels.
    pub(super) fn new(
        channels: Channels,
        shape: FeatureShape,
        scale: OutputScale,
        trees: Vec<Member>,
    ) -> TreeRegressor {
        TreeRegressor {
            channels,
            shape,
            scale,
            trees,
        }
    }

    /// Number of trees.
    pub fn trees(&self) -> usize {
        self.trees.len()
    }

    fn write(&self, sample: &[f32], into: &mut [f64]) {
        into.fill(0.0);
        for Member { tree, channel } in &self.trees {
            let leaf = tree.leaf(sample);
            match channel {
                Some(channel) => into[*channel] += tree.values[leaf],
                None => {
                    let values = &tree.values[leaf * into.len()..];
                    into.iter_mut()
                        .zip(values)
                        .for_each(|(place, value)| *place += value);
                }
            }
        }
        self.scale.unscale(into);
    }

    /// Loads the model from a file.
    pub(crate) fn load(stored: &Stored<'_>) -> Result<ModelRegressor, FormatError> {
        stored.on_components(TreeRegressor::from_tensors)
    }

    /// Builds the model from the tensors of a file. Rejects trees with an invalid child, an unknown feature or a number that is not finite.
    fn from_tensors(
        tensors: &Tensors<'_>,
        channels: Channels,
        shape: FeatureShape,
    ) -> Result<TreeRegressor, FormatError> {
        let count = channels.len();
        let (trees, nodes) = (tensors.rows(SIZE)?, tensors.rows(LEFT)?);
        let sizes = tensors.integers(SIZE, &[trees])?;
        let owners = tensors.integers(CHANNEL, &[trees])?;
        let mut feature = tensors.integers(FEATURE, &[nodes])?.into_iter();
        let mut threshold = tensors.singles(THRESHOLD, &[nodes])?.into_iter();
        let mut left = tensors.integers(LEFT, &[nodes])?.into_iter();
        let numbers = tensors.rows(VALUES)?;
        let mut values = tensors.doubles(VALUES, &[numbers])?.into_iter();
        let mut members = Vec::new();
        for (size, owner) in sizes.into_iter().zip(owners) {
            let size = size as usize;
            let channel = (owner != ALL).then_some(owner as usize);
            let width = if channel.is_none() { count } else { 1 };
            let places = size.checked_mul(width).ok_or(FormatError::Card)?;
            let tree = Tree {
                feature: feature.by_ref().take(size).collect(),
                threshold: threshold.by_ref().take(size).collect(),
                left: left.by_ref().take(size).collect(),
                values: values.by_ref().take(places).collect(),
            };
            let whole = tree.left.len() == size && tree.values.len() == places;
            let known = channel.is_none_or(|channel| channel < count);
            if !(whole && known && is_sound(&tree, shape.len())) {
                return Err(FormatError::Card);
            }
            members.push(Member { tree, channel });
        }
        let scale = OutputScale {
            offset: tensors.doubles(OFFSET, &[count])?,
            span: tensors.doubles(SPAN, &[count])?,
        };
        let rest = left.next().is_some() || values.next().is_some();
        if rest || !scale.is_valid(count) {
            return Err(FormatError::Card);
        }
        Ok(TreeRegressor::new(channels, shape, scale, members))
    }
}

/// True if every child comes after its parent, every compared feature exists and every number is finite.
fn is_sound(tree: &Tree, features: usize) -> bool {
    let nodes = tree.left.len();
    let mut asked = tree.left.iter().zip(&tree.feature).enumerate();
    let leads_on = asked.all(|(node, (&left, &feature))| {
        let left = left as usize;
        left == 0 || (left > node && left + 1 < nodes && (feature as usize) < features)
    });
    let finite = tree.threshold.iter().all(|value| value.is_finite())
        && tree.values.iter().all(|value| value.is_finite());
    nodes > 0 && leads_on && finite
}

impl FittedModel for TreeRegressor {
    fn kind(&self) -> KindCard {
        KindCard::from(Form::Trees {
            trees: self.trees(),
        })
    }

    fn tensors(&self) -> Vec<Raw> {
        let trees = || self.trees.iter().map(|member| &member.tree);
        let short = |value: usize| u32::try_from(value).expect("fewer than 2^32");
        let sizes: Vec<u32> = trees().map(|tree| short(tree.left.len())).collect();
        let of = |member: &Member| member.channel.map_or(ALL, short);
        let channels: Vec<u32> = self.trees.iter().map(of).collect();
        let features: Vec<u32> = trees()
            .flat_map(|tree| tree.feature.iter().copied())
            .collect();
        let left: Vec<u32> = trees().flat_map(|tree| tree.left.iter().copied()).collect();
        let threshold: Vec<f32> = trees()
            .flat_map(|tree| tree.threshold.iter().copied())
            .collect();
        let values: Vec<f64> = trees()
            .flat_map(|tree| tree.values.iter().copied())
            .collect();
        let count = self.channels.len();
        vec![
            Raw::integers(CHANNEL, vec![channels.len()], &channels),
            Raw::integers(FEATURE, vec![features.len()], &features),
            Raw::integers(LEFT, vec![left.len()], &left),
            Raw::doubles(OFFSET, vec![count], &self.scale.offset),
            Raw::integers(SIZE, vec![sizes.len()], &sizes),
            Raw::doubles(SPAN, vec![count], &self.scale.span),
            Raw::singles(THRESHOLD, vec![threshold.len()], &threshold),
            Raw::doubles(VALUES, vec![values.len()], &values),
        ]
    }

    fn reads_features(&self) -> bool {
        self.trees.iter().any(|member| member.tree.left[0] > 0)
    }
}

impl Regressor for TreeRegressor {
    fn channels(&self) -> &Channels {
        &self.channels
    }

    fn shape(&self) -> FeatureShape {
        self.shape
    }

    fn predict(&self, features: &Features, into: &mut [f64]) -> Result<(), ModelError> {
        check_call(&self.channels, self.shape, features, into)?;
        let (channels, width) = (self.channels.len(), self.shape.len());
        into.par_chunks_mut(CHUNK * channels)
            .zip(features.values().par_chunks(CHUNK * width))
            .for_each(|(into, samples)| {
                let samples = samples.chunks_exact(width);
                for (into, sample) in into.chunks_exact_mut(channels).zip(samples) {
                    self.write(sample, into);
                }
            });
        check_finite(&self.channels, into)
    }
}
