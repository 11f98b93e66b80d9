//! States of accumulators as data, for files and for merging in another process.

use std::collections::BTreeMap;

use taceva_core::{Channels, Unit};

use crate::error::MetricError;
use crate::exact::record::Record;
use crate::stats::clusters::Clusters;
use crate::stats::row_groups::HASHED_CLUSTERS;

/// Mergeable summary of a set of samples.
///
/// Equal sets of samples have equal states, for any order, split or merge. Equal states stay equal in a file format that keeps every bit
/// of a number: `serde_json` needs its feature `float_roundtrip`.
///
/// ```
/// use taceva_metrics::{Channel, Evaluator};
/// let mut evaluator = Evaluator::of_channels([Channel::FZ])?;
/// evaluator.update_pairs(Channel::FZ, &[0.25], &[0.5])?;
/// let mut elsewhere = Evaluator::of_channels([Channel::FZ])?;
/// elsewhere.merge_states(&evaluator.states()?)?;
/// assert_eq!(elsewhere.states()?, evaluator.states()?);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct State {
    pub(crate) schema: String,
    pub(crate) parameters: BTreeMap<String, String>,
    pub(crate) channels: Vec<(String, Unit)>,
    pub(crate) clusters: Clusters<Vec<Record>>,
}

impl State {
    /// Name and version of the schema, such as `taceva.pairs/1`.
    pub fn schema(&self) -> &str {
        &self.schema
    }

    /// Parameters of the accumulator. Only states with equal parameters merge.
    pub fn parameters(&self) -> &BTreeMap<String, String> {
        &self.parameters
    }

    /// Channels of the samples, with their units.
    pub fn channels(&self) -> &[(String, Unit)] {
        &self.channels
    }

    /// Sums of each cluster of samples, as one record per channel or plane.
    pub fn clusters(&self) -> &Clusters<Vec<Record>> {
        &self.clusters
    }

    /// Rejects an incomplete state, or a state that differs from `own` in schema, channels or parameters.
    pub(crate) fn check(&self, own: &Shape) -> Result<(), MetricError> {
        if self.schema != own.schema {
            return Err(MetricError::Schema {
                expected: format!("`{}`", own.schema),
                found: self.schema.clone(),
            });
        }
        if self.channels != own.channels {
            return Err(MetricError::Channels {
                expected: describe(&own.channels),
                found: describe(&self.channels),
            });
        }
        if self.parameters != own.parameters {
            return Err(MetricError::Parameter {
                name: "parameters",
                expected: format!("{:?}", own.parameters),
                found: format!("{:?}", self.parameters),
            });
        }
        match &self.clusters {
            Clusters::Hashed(cells) if cells.len() != HASHED_CLUSTERS => {
                Err(MetricError::Malformed {
                    schema: own.schema,
                    what: format!("{} clusters, expected {HASHED_CLUSTERS}", cells.len()),
                })
            }
            _ => Ok(()),
        }
    }
}

/// Schema, parameters and channels that a state must have to be merged.
pub(crate) struct Shape {
    pub(crate) schema: &'static str,
    pub(crate) parameters: BTreeMap<String, String>,
    pub(crate) channels: Vec<(String, Unit)>,
}

/// Names and units of `channels`, as a state stores them.
pub(crate) fn written(channels: &Channels) -> Vec<(String, Unit)> {
    channels
        .iter()
        .map(|channel| (channel.name().to_owned(), channel.unit()))
        .collect()
}

/// Names and units of channels as text for a message, such as `Px [mm], Fz [N]`.
pub(crate) fn describe(channels: &[(String, Unit)]) -> String {
    let names: Vec<String> = channels
        .iter()
        .map(|(name, unit)| format!("{name} [{unit}]"))
        .collect();
    names.join(", ")
}
