//! What the host and its child say to each other about models. Arrays lie in shared memory beside the words.

use taceva_core::{ArgValue, Channel, Channels, DriverKey, FeatureShape, Unit};

use super::value::listed;
use super::{Failure, Malformed, Reader, Wire, fields, messages};

messages! {
    /// What a child is asked to make a model from; a socket for the talk about it comes beside it, and memory.
    #[derive(Clone, Debug, PartialEq)]
    enum ModelOrder: "an order for a model" {
        /// Fits; beside it the memory of `training`, and of `validation` if there is one.
        0 => Fit {
            estimator: DriverKey,
            settings: Vec<(String, ArgValue)>,
            training: SetShape,
            validation: Option<SetShape>,
        },
        /// Loads; beside it the memory of as many bytes as were saved.
        1 => Load { estimator: DriverKey, channels: Channels, shape: FeatureShape, length: u64 },
    }
}

/// What a set of samples is like; its numbers are in memory.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SetShape {
    pub(crate) samples: u64,
    pub(crate) shape: FeatureShape,
    pub(crate) channels: Channels,
    /// Whether it is known which samples belong together.
    pub(crate) has_groups: bool,
}

messages! {
    /// What a child says while a model is made.
    #[derive(Clone, Debug, PartialEq)]
    enum ModelEvent: "an event of a fit" {
        0 => Begins { stage: String, steps: Option<u64> },
        1 => Advances { steps: u64 },
        2 => Ends {},
        /// There is a model, which answers calls from now on.
        3 => Made {},
        4 => Failed { failure: Failure },
    }

    /// What the host says while a model is made.
    #[derive(Clone, Debug, PartialEq)]
    enum ModelWord: "a word about a fit" {
        0 => Cancel {},
    }

    /// A call to a model.
    #[derive(Clone, Debug, PartialEq)]
    enum ModelCall: "a call to a model" {
        /// Predicts; beside it memory that holds the features, and the predictions afterwards.
        0 => Predict { samples: u64 },
        /// Makes the bytes to be kept, and says how many.
        1 => Save {},
        /// Writes them into the memory beside it.
        2 => Fetch {},
        3 => Close {},
    }

    /// The answer to a [`ModelCall`].
    #[derive(Clone, Debug, PartialEq)]
    enum ModelAnswer: "the answer of a model" {
        0 => Done {},
        1 => Saved { length: u64 },
        2 => Failed { failure: Failure },
    }
}

fields!(SetShape {
    samples,
    shape,
    channels,
    has_groups
});

listed! {
    Unit, Unit::ALL, "a unit";
}

impl Wire for FeatureShape {
    fn write(&self, into: &mut Vec<u8>) {
        for side in [self.height, self.width, self.depth] {
            // A side beyond 2³² makes a shape that no memory holds.
            u32::try_from(side).unwrap_or(u32::MAX).write(into);
        }
    }

    fn read(from: &mut Reader<'_>) -> Result<FeatureShape, Malformed> {
        let mut side = || {
            let side = u32::read(from)?;
            usize::try_from(side).map_err(|_| from.malformed("a side of features"))
        };
        Ok(FeatureShape {
            height: side()?,
            width: side()?,
            depth: side()?,
        })
    }
}

impl Wire for Channels {
    fn write(&self, into: &mut Vec<u8>) {
        let pair = |channel: &Channel| (channel.name().to_owned(), channel.unit());
        let pairs: Vec<(String, Unit)> = self.iter().map(pair).collect();
        pairs.write(into);
    }

    fn read(from: &mut Reader<'_>) -> Result<Channels, Malformed> {
        let pairs = Vec::<(String, Unit)>::read(from)?;
        let channels: Result<Vec<Channel>, _> = pairs
            .iter()
            .map(|(name, unit)| Channel::named(name, *unit))
            .collect();
        channels
            .and_then(Channels::new)
            .map_err(|_| from.malformed("channels, each once"))
    }
}
