//! Requirements of a consumer on the stream of samples.

use crate::field::FieldSet;

/// Requirements of a metric or another consumer on a stream. Requirements are plain data, so planning opens neither devices nor files.
///
/// ```
/// use taceva_core::{FieldSet, Needs};
/// let needs = Needs::new(FieldSet::PAIRS).with_channels(&["Fz"]).with_least_samples(2);
/// assert_ne!(needs, Needs::default());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Needs {
    /// Required fields of each sample.
    pub fields: FieldSet,
    /// Required channels of each sample.
    pub channels: &'static [&'static str],
    /// Least number of samples. With fewer samples the value is undefined.
    pub least_samples: u64,
}

impl Needs {
    /// Requires only `fields`, with any channels and any number of samples.
    pub const fn new(fields: FieldSet) -> Needs {
        Needs {
            fields,
            channels: &[],
            least_samples: 0,
        }
    }

    /// The same requirements with required channels.
    #[must_use]
    pub const fn with_channels(self, channels: &'static [&'static str]) -> Needs {
        Needs { channels, ..self }
    }

    /// The same requirements with the least number of samples.
    #[must_use]
    pub const fn with_least_samples(self, least_samples: u64) -> Needs {
        Needs {
            least_samples,
            ..self
        }
    }
}
