//! Training data of a model: features, target values and groups.

use super::Features;
use crate::channel::Channels;

/// True values that a model learns to predict, one row per sample.
///
/// # Shapes
/// `values`: `[samples, channels]`.
///
/// ```
/// use taceva_core::{Channel, Channels, Targets};
/// let channels = Channels::new([Channel::PZ, Channel::FZ])?;
/// let targets = Targets::new(&channels, &[0.5, 1.0, 0.7, 1.6]);
/// assert_eq!(targets.values.len(), 2 * channels.len());
/// # Ok::<(), taceva_core::ChannelError>(())
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct Targets<'a> {
    /// Channel of each column.
    pub channels: &'a Channels,
    /// Finite true values, one row per sample and one column per channel.
    pub values: &'a [f64],
}

impl<'a> Targets<'a> {
    /// Targets with one row of values per sample. An estimator rejects `values` if the number of rows differs from its number of samples.
    pub const fn new(channels: &'a Channels, values: &'a [f64]) -> Targets<'a> {
        Targets { channels, values }
    }
}

/// Samples on which a model is fitted, or on which its settings are chosen.
///
/// ```
/// use taceva_core::{Channel, Channels, FeatureShape, Features, Targets, TrainingSet};
/// let channels = Channels::new([Channel::FZ])?;
/// let features = Features::new(FeatureShape::flat(2), vec![0.1, 0.2, 0.3, 0.4])?;
/// let targets = Targets::new(&channels, &[1.0, 1.6]);
/// let training = TrainingSet::new(&features, targets).with_groups(&[0, 1][..]);
/// assert_eq!(training.groups, Some(&[0, 1][..]));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub struct TrainingSet<'a> {
    /// Features of each sample.
    pub features: &'a Features,
    /// Target values of each sample.
    pub targets: Targets<'a>,
    /// Group of each sample, such as its contact point. Cross-validation leaves out whole groups; `None` without groups.
    pub groups: Option<&'a [u32]>,
}

impl<'a> TrainingSet<'a> {
    /// Samples without groups for cross-validation.
    pub const fn new(features: &'a Features, targets: Targets<'a>) -> TrainingSet<'a> {
        TrainingSet {
            features,
            targets,
            groups: None,
        }
    }

    /// Sets the group of each sample for cross-validation.
    #[must_use]
    pub fn with_groups(self, groups: impl Into<Option<&'a [u32]>>) -> TrainingSet<'a> {
        TrainingSet {
            groups: groups.into(),
            ..self
        }
    }
}
