//! Requirements of a consumer on a stream.

use crate::field::FieldSet;

/// Requirements of a metric or another consumer on a stream. Pure data, so planning opens neither devices nor files.
///
/// ```
/// use taceva_core::{FieldSet, Needs};
/// let needs = Needs::new(FieldSet::PAIRS).with_channels(&["Fz"]).with_least_samples(2);
/// assert_ne!(needs, Needs::default());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Needs {
    /// Fields that a value requires.
    pub fields: FieldSet,
    /// Channels that a value requires.
    pub channels: &'static [&'static str],
    /// Least number of samples; with fewer the value is undefined.
    pub least_samples: u64,
}

impl Needs {
    /// Requires `fields` alone, with any channels and any number of samples.
    pub const fn new(fields: FieldSet) -> Needs {
        Needs {
            fields,
            channels: &[],
            least_samples: 0,
        }
    }

    /// The same with required channels.
    #[must_use]
    pub const fn with_channels(self, channels: &'static [&'static str]) -> Needs {
        Needs { channels, ..self }
    }

    /// The same with the least number of samples.
    #[must_use]
    pub const fn with_least_samples(self, least_samples: u64) -> Needs {
        Needs {
            least_samples,
            ..self
        }
    }
}
