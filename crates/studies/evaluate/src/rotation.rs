//! Angles between predicted and true rotations.

use taceva_core::Orientation;
use taceva_dataset::Dataset;

use crate::note::Note;
use crate::predict::Predicted;

/// Notes on each rotation of `dataset` whose channels are all predicted.
pub(crate) fn rotations(dataset: &Dataset, predicted: &Predicted) -> Vec<Note> {
    let rotations = dataset.header().rotations.iter();
    rotations
        .filter_map(|channels| of_rotation(channels, predicted))
        .collect()
}

fn of_rotation(channels: &[String], predicted: &Predicted) -> Option<Note> {
    let positions = channels.iter();
    let positions: Option<Vec<usize>> = positions
        .map(|name| predicted.channels().position(name))
        .collect();
    let positions = positions?;
    let rows = predicted.truth().first()?.len();
    let of = |columns: &[taceva_core::Column], row: usize| {
        let parts: Option<Vec<f64>> = positions
            .iter()
            .map(|position| columns[*position].get(row))
            .collect();
        orientation(&parts?)
    };
    let mut angles: Vec<f64> = (0..rows)
        .filter_map(|row| {
            let truth = of(predicted.truth(), row)?;
            Some(truth.angle_to(of(predicted.prediction(), row)?).0)
        })
        .collect();
    angles.sort_by(f64::total_cmp);
    let most = *angles.get(angles.len().checked_sub(1)? * 19 / 20)?;
    let mean = angles.iter().sum::<f64>() / angles.len() as f64;
    Some(Note::Rotation {
        channels: channels.to_vec(),
        samples: angles.len(),
        mean,
        most,
    })
}

/// Orientation from a rotation vector in degrees, or from a quaternion of any nonzero length; `None` for other `parts`.
fn orientation(parts: &[f64]) -> Option<Orientation> {
    match *parts {
        [x, y, z] => Some(Orientation::of_vector([x, y, z].map(f64::to_radians))),
        [x, y, z, w] => {
            let length = parts.iter().map(|part| part * part).sum::<f64>().sqrt();
            Orientation::of_quaternion([x, y, z, w].map(|part| part / length))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rotation_in_degrees_and_a_quaternion_of_another_length_are_one_orientation() {
        let vector = orientation(&[0.0, 0.0, 90.0]).expect("a rotation");
        let quaternion = orientation(&[0.0, 0.0, 2.0, 2.0]).expect("a rotation");
        assert!(vector.angle_to(quaternion).0 < 1e-9);
        let opposite = orientation(&[0.0, 0.0, -270.0]).expect("a rotation");
        assert!(vector.angle_to(opposite).0 < 1e-9);
        assert_eq!(orientation(&[0.0; 4]), None);
        assert_eq!(orientation(&[1.0]), None);
    }
}
