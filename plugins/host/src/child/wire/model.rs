//! Messages about models between the host and its child. Arrays are passed in shared memory.

use taceva_core::{ArgValue, Channel, Channels, DriverKey, FeatureShape, Unit};

use super::value::listed;
use super::{Failure, Malformed, Reader, Wire, fields, messages};

messages! {
    /// Order to make a model. The order transfers a socket for messages about the model, and shared memory.
    #[derive(Clone, Debug, PartialEq)]
    enum ModelOrder: "an order for a model" {
        /// Fits a model. The order transfers the shared memory of `training`, and of `validation` if present.
        0 => Fit {
            estimator: DriverKey,
            settings: Vec<(String, ArgValue)>,
            training: SetShape,
            validation: Option<SetShape>,
        },
        /// Loads a model from shared memory of `length` bytes.
        1 => Load { estimator: DriverKey, channels: Channels, shape: FeatureShape, length: u64 },
    }
}

/// Shape of a set of samples. The numbers are in shared memory.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SetShape {
    pub(crate) samples: u64,
    pub(crate) shape: FeatureShape,
    pub(crate) channels: Channels,
    /// True if the set has group numbers.
    pub(crate) has_groups: bool,
}

messages! {
    /// Message of a child while it makes a model.
    #[derive(Clone, Debug, PartialEq)]
    enum ModelEvent: "an event of a fit" {
        0 => Begins { stage: String, steps: Option<u64> },
        1 => Advances { steps: u64 },
        2 => Ends {},
        /// The model is ready to answer calls.
        3 => Made {},
        4 => Failed { failure: Failure },
    }

    /// Message of the host while a model is made.
    #[derive(Clone, Debug, PartialEq)]
    enum ModelWord: "a message about a fit" {
        0 => Cancel {},
    }

    /// A call to a model.
    #[derive(Clone, Debug, PartialEq)]
    enum ModelCall: "a call to a model" {
        /// Predicts. Reads the features from the shared memory and overwrites them with the predictions.
        0 => Predict { samples: u64 },
        /// Saves the model in the child and returns the length, bytes.
        1 => Save {},
        /// Writes the saved bytes into the shared memory.
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
            // A side above 2³² belongs to a shape that exceeds any memory.
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
            .map_err(|_| from.malformed("channels without duplicates"))
    }
}
