//! What the host and its child say to each other about models. Arrays lie in shared memory beside the words.

use taceva_core::{ArgValue, Channel, Channels, DriverKey, FeatureShape, Unit};

use super::value::listed;
use super::{Failure, Malformed, Reader, Wire, fields, variants};

/// What a child is asked to make a model from; a socket for the talk about it comes beside it, and memory.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ModelOrder {
    /// Fits; beside it the memory of `training`, and of `validation` if there is one.
    Fit {
        estimator: DriverKey,
        settings: Vec<(String, ArgValue)>,
        training: SetShape,
        validation: Option<SetShape>,
    },
    /// Loads; beside it the memory of as many bytes as were saved.
    Load {
        estimator: DriverKey,
        channels: Channels,
        shape: FeatureShape,
        length: u64,
    },
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

/// What a child says while a model is made.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ModelEvent {
    Begins {
        stage: String,
        steps: Option<u64>,
    },
    Advances {
        steps: u64,
    },
    Ends {},
    /// There is a model, which answers calls from now on.
    Made {},
    Failed {
        failure: Failure,
    },
}

/// What the host says while a model is made.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ModelWord {
    Cancel {},
}

/// A call to a model.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ModelCall {
    /// Predicts; beside it memory that holds the features, and the predictions afterwards.
    Predict {
        samples: u64,
    },
    /// Makes the bytes to be kept, and says how many.
    Save {},
    /// Writes them into the memory beside it.
    Fetch {},
    Close {},
}

/// The answer to a [`ModelCall`].
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum ModelAnswer {
    Done {},
    Saved { length: u64 },
    Failed { failure: Failure },
}

fields!(SetShape {
    samples,
    shape,
    channels,
    has_groups
});

variants!(ModelOrder, "an order for a model" {
    0 => Fit { estimator, settings, training, validation },
    1 => Load { estimator, channels, shape, length },
});

variants!(ModelEvent, "an event of a fit" {
    0 => Begins { stage, steps },
    1 => Advances { steps },
    2 => Ends {},
    3 => Made {},
    4 => Failed { failure },
});

variants!(ModelWord, "a word about a fit" {
    0 => Cancel {},
});

variants!(ModelCall, "a call to a model" {
    0 => Predict { samples },
    1 => Save {},
    2 => Fetch {},
    3 => Close {},
});

variants!(ModelAnswer, "the answer of a model" {
    0 => Done {},
    1 => Saved { length },
    2 => Failed { failure },
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
