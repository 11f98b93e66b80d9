//! Training set in the form of the plugin interface.

use taceva_abi as abi;
use taceva_core::{ErrorKind, TrainingSet};

use crate::call::Failure;

/// Training set in the form of the plugin interface, with the texts to which it points.
pub(super) struct Lent<'a> {
    set: &'a TrainingSet<'a>,
    names: Vec<abi::Text>,
    sides: [u32; 3],
    channels: u32,
}

impl<'a> Lent<'a> {
    pub(super) fn new(set: &'a TrainingSet<'a>) -> Result<Lent<'a>, Failure> {
        let refused = |why: String| Failure::new(ErrorKind::InvalidArgument, why);
        let shape = set.features.shape();
        let samples = set.features.samples();
        let channels = set.targets.channels.len();
        let fits = set.targets.values.len() == samples * channels
            && set.groups.is_none_or(|groups| groups.len() == samples);
        if !fits {
            let why = format!(
                "{samples} samples of {channels} channels, with {} targets, expected a target for each sample and channel, and no group or a group for each sample",
                set.targets.values.len()
            );
            return Err(refused(why));
        }
        let is_finite = set.features.values().iter().all(|value| value.is_finite())
            && set.targets.values.iter().all(|value| value.is_finite());
        if !is_finite {
            return Err(refused("a feature or a target is not finite".to_owned()));
        }
        let narrow = |side: usize| {
            u32::try_from(side).map_err(|_| {
                refused(format!(
                    "a side of {side} features, expected at most {}",
                    u32::MAX
                ))
            })
        };
        Ok(Lent {
            set,
            names: (set.targets.channels.iter())
                .map(|channel| abi::Text::from(channel.name()))
                .collect(),
            sides: [
                narrow(shape.height)?,
                narrow(shape.width)?,
                narrow(shape.depth)?,
            ],
            channels: narrow(channels)?,
        })
    }

    pub(super) fn set(&self) -> abi::TrainingSet {
        let [height, width, depth] = self.sides;
        abi::TrainingSet {
            size: u32::try_from(size_of::<abi::TrainingSet>()).expect("a small struct"),
            channels: self.channels,
            samples: self.set.features.samples() as u64,
            height,
            width,
            depth,
            reserved: 0,
            features: self.set.features.values().as_ptr(),
            targets: self.set.targets.values.as_ptr(),
            groups: self.set.groups.map_or(std::ptr::null(), <[u32]>::as_ptr),
            channel_names: self.names.as_ptr(),
        }
    }
}
