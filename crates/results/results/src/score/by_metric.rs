//! Scores grouped by metric: `{"mae": {"Fz": …}}`.

use serde::de::{Deserialize, Deserializer};
use serde::ser::{Serialize, SerializeMap, Serializer};

use super::Score;
use crate::ordered_map::Ordered;

/// Writes scores as objects by metric and channel, for `#[serde(with = "…")]`.
///
/// # Errors
/// Errors of the serializer.
pub fn serialize<S: Serializer>(scores: &[Score], serializer: S) -> Result<S::Ok, S::Error> {
    let mut metrics = serializer.serialize_map(None)?;
    for of_one in scores.chunk_by(|left, right| left.metric == right.metric) {
        metrics.serialize_entry(&of_one[0].metric, &ByChannel(of_one))?;
    }
    metrics.end()
}

struct ByChannel<'a>(&'a [Score]);

impl Serialize for ByChannel<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|score| (&score.channel, score)))
    }
}

/// Reads the output of [`serialize`].
///
/// # Errors
/// Errors of the deserializer.
pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Score>, D::Error> {
    let metrics: Ordered<Ordered<Score>> = Ordered::deserialize(deserializer)?;
    let mut scores = Vec::new();
    for (metric, channels) in metrics.0 {
        scores.extend(channels.0.into_iter().map(|(channel, score)| Score {
            metric: metric.clone(),
            channel,
            ..score
        }));
    }
    Ok(scores)
}
