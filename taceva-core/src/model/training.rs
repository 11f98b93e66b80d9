//! Training data of a model.

use super::Features;
use crate::channel::Channels;

/// True values for a fit, sample by sample.
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
    /// Finite values, one row per sample.
    pub values: &'a [f64],
}

impl<'a> Targets<'a> {
    /// Targets with one value per channel, sample by sample. An estimator rejects `values` whose number does not match its samples.
    pub const fn new(channels: &'a Channels, values: &'a [f64]) -> Targets<'a> {
        Targets { channels, values }
    }
}

/// Samples for a fit or for the choice of settings.
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
    /// The features of each sample.
    pub features: &'a Features,
    /// Target values of each sample.
    pub targets: Targets<'a>,
    /// Group of each sample, for settings chosen by leaving out one group at a time; `None` without groups.
    pub groups: Option<&'a [u32]>,
}

impl<'a> TrainingSet<'a> {
    /// Samples without groups.
    pub const fn new(features: &'a Features, targets: Targets<'a>) -> TrainingSet<'a> {
        TrainingSet {
            features,
            targets,
            groups: None,
        }
    }

    /// The same samples with the group of each sample.
    #[must_use]
    pub fn with_groups(self, groups: impl Into<Option<&'a [u32]>>) -> TrainingSet<'a> {
        TrainingSet {
            groups: groups.into(),
            ..self
        }
    }
}
