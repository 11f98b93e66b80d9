//! What a consumer requires of a stream before it can say anything.

use crate::field::FieldSet;

/// What a metric or another consumer needs; pure data, so that planning needs neither devices nor files.
///
/// ```
/// use taceva_core::{FieldSet, Needs};
/// let needs = Needs { fields: FieldSet::PAIRS, channels: &["Fz"], least_samples: 2 };
/// assert_ne!(needs, Needs::default());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Needs {
    /// Fields without which there is no value.
    pub fields: FieldSet,
    /// Channels without which there is no value.
    pub channels: &'static [&'static str],
    /// Samples below which the value is undefined.
    pub least_samples: u64,
}
