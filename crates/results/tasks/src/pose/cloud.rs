//! Distances between an object's points in two poses.

use taceva_metrics::{ExactSum, NearestPoints};

use super::rigid::Pose;
use crate::vector::{length, minus};

/// Sums of distances between an object's points in a true and in a predicted pose, mm.
pub(super) struct PointDistances {
    /// Sum of the distances between the positions of each point in both poses, as in the score ADD.
    pub(super) same: ExactSum,
    /// Sum of the distances from each true point to the nearest predicted point, as in the score ADD-S.
    pub(super) nearest: ExactSum,
}

impl PointDistances {
    /// Sums of the distances of `points`.
    ///
    /// # Reference
    /// Hinterstoisser et al., Model based training, detection and pose estimation of texture-less 3D objects, ACCV (2012): ADD;
    /// Xiang et al., PoseCNN, RSS (2018): ADD-S.
    pub(super) fn of(points: &[[f64; 3]], truth: &Pose, prediction: &Pose) -> PointDistances {
        let place = |pose: &Pose| -> Vec<[f64; 3]> {
            points.iter().map(|&point| pose.apply(point)).collect()
        };
        let (truth, prediction) = (place(truth), place(prediction));
        let pairs = truth.iter().zip(&prediction);
        let same = pairs.map(|(&truth, &prediction)| length(minus(truth, prediction)));
        let search = NearestPoints::new(prediction.iter().copied());
        let nearest = truth.iter().filter_map(|&point| search.nearest(point));
        PointDistances {
            same: same.collect(),
            nearest: nearest.map(|found| found.squared.sqrt()).collect(),
        }
    }
}
