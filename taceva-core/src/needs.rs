//! What a consumer requires of a stream before it can give a value.

use crate::field::FieldSet;

/// What a metric or another consumer needs; pure data, so that planning needs neither devices nor files.
///
/// ```
/// use taceva_core::{FieldSet, Needs};
/// let needs = Needs::new(FieldSet::PAIRS).with_channels(&["Fz"]).with_least_samples(2);
/// assert_ne!(needs, Needs::default());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Needs {
    /// Fields without which there is no value.
    pub fields: FieldSet,
    /// Channels without which there is no value.
    pub channels: &'static [&'static str],
    /// Samples below which the value is undefined.
    pub least_samples: u64,
}

impl Needs {
    /// What needs `fields`, and no channel and no number of samples in particular.
    pub const fn new(fields: FieldSet) -> Needs {
        Needs {
            fields,
            channels: &[],
            least_samples: 0,
        }
    }

    /// The same with the channels without which there is no value.
    #[must_use]
    pub const fn with_channels(self, channels: &'static [&'static str]) -> Needs {
        Needs { channels, ..self }
    }

    /// The same with the number of samples below which the value is undefined.
    #[must_use]
    pub const fn with_least_samples(self, least_samples: u64) -> Needs {
        Needs {
            least_samples,
            ..self
        }
    }
}
