//! Limits of the distance between a sample and the training part.

use serde::{Deserialize, Serialize};

use crate::features::FeatureDistance;

/// Limits of the distance from the training part. A sample beyond a limit is unlike the training samples; see [`FeatureDistance`].
///
/// ```
/// let text = r#"{"along": 2.1, "beside": 0.015}"#;
/// let card: taceva_models::DistanceCard = serde_json::from_str(text)?;
/// assert_eq!(card.along, 2.1);
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct DistanceCard {
    /// Limit along the principal directions of the training features, in their standard deviations.
    pub along: f64,
    /// Limit orthogonal to the principal directions of the training features, in the units of the features.
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
