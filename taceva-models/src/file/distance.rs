//! Stores the distance of features from the training part as tensors of a model file.

use crate::features::{DistanceLimits, FeatureDistance};
use crate::training::file::content::Stored;
use crate::training::file::error::FormatError;
use crate::training::file::tensors::{DEVIATIONS, DIRECTIONS, DISTANCE, MEAN, Raw};

pub(super) fn distance_tensors(distance: &FeatureDistance) -> [Raw; 3] {
    let (count, width) = (distance.deviations.len(), distance.mean.len());
    [
        Raw::singles(DIRECTIONS, vec![count, width], &distance.directions),
        Raw::doubles(MEAN, vec![width], &distance.mean),
        Raw::doubles(DEVIATIONS, vec![count], &distance.deviations),
    ]
}

/// Reads the distance from a model file whose card states its limits; `None` for older models without a distance.
pub(super) fn distance_from(stored: &Stored<'_>) -> Result<Option<FeatureDistance>, FormatError> {
    let (tensors, shape) = (&stored.tensors, stored.shape());
    let Some(card) = stored.card.distance else {
        return match DISTANCE.into_iter().find(|name| tensors.has(name)) {
            None => Ok(None),
            Some(name) => Err(FormatError::Unexpected {
                name: name.to_owned(),
            }),
        };
    };
    let (count, width) = (tensors.rows(DEVIATIONS)?, FeatureDistance::width_of(shape));
    let distance = FeatureDistance {
        shape,
        mean: tensors.doubles(MEAN, &[width])?,
        directions: tensors.singles(DIRECTIONS, &[count, width])?,
        deviations: tensors.doubles(DEVIATIONS, &[count])?,
        limits: DistanceLimits {
            along: card.along,
            beside: card.beside,
        },
    };
    match is_sound(&distance) {
        true => Ok(Some(distance)),
        false => Err(FormatError::Card),
    }
}

/// True if all numbers of `distance` are finite, and its deviations and limits are positive.
fn is_sound(distance: &FeatureDistance) -> bool {
    let DistanceLimits { along, beside } = distance.limits;
    let is_divisor = |value: &f64| value.is_finite() && *value > 0.0;
    let mut directions = distance.directions.iter();
    !distance.deviations.is_empty()
        && distance
            .deviations
            .iter()
            .chain([&along, &beside])
            .all(is_divisor)
        && directions.all(|number| number.is_finite())
        && distance.mean.iter().all(|number| number.is_finite())
}
