//! Requirements of a metric on the samples that it reads.

use crate::field::FieldSet;

/// Fields, channels and number of samples that a metric requires. Planning reads these requirements before a device or a file is opened.
///
/// ```
/// use taceva_core::{FieldSet, Needs};
/// let needs = Needs::new(FieldSet::PAIRS).with_channels(&["Fz"]).with_least_samples(2);
/// assert_ne!(needs, Needs::default());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Needs {
    /// Fields that each sample must have.
    pub fields: FieldSet,
    /// Names of the channels that each sample must have.
    pub channels: &'static [&'static str],
    /// Minimum number of samples. With fewer samples, the value of the metric is undefined.
    pub least_samples: u64,
}

impl Needs {
    /// Requires only `fields`, without required channels or a minimum number of samples.
    pub const fn new(fields: FieldSet) -> Needs {
        Needs {
            fields,
            channels: &[],
            least_samples: 0,
        }
    }

    /// Sets the names of the required channels.
    #[must_use]
    pub const fn with_channels(self, channels: &'static [&'static str]) -> Needs {
        Needs { channels, ..self }
    }

    /// Sets the minimum number of samples.
    #[must_use]
    pub const fn with_least_samples(self, least_samples: u64) -> Needs {
        Needs {
            least_samples,
            ..self
        }
    }
}
