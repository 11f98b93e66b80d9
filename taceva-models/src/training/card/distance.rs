//! Limits of the training distance.

use serde::{Deserialize, Serialize};

use crate::features::FeatureDistance;

/// Limits above which a sample is unlike the training part; see [`FeatureDistance`].
///
/// ```
/// let text = r#"{"along": 2.1, "beside": 0.015}"#;
/// let card: taceva_models::DistanceCard = serde_json::from_str(text)?;
/// assert_eq!(card.along, 2.1);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DistanceCard {
    /// Limit along the directions of the training part, in the part's standard deviations.
    pub along: f64,
    /// Limit orthogonal to the directions, in units of the features.
    pub beside: f64,
}

impl DistanceCard {
    pub(crate) fn of(distance: &FeatureDistance) -> DistanceCard {
        DistanceCard {
            along: distance.limits.along,
            beside: distance.limits.beside,
        }
    }
}
