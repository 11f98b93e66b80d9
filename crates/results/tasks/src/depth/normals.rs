//! Angles between the normals of two surfaces.

use taceva_metrics::ExactSum;

use super::map::DepthMap;
use crate::vector::{cross, degrees, dot, length};

/// Normal of a flat surface.
const FLAT: [f64; 3] = [0.0, 0.0, 1.0];

/// Sums of the angles between true and other normals, in degrees.
#[derive(Default)]
pub(super) struct NormalAngles {
    /// Sum of the angles between true and predicted normals, degrees.
    pub(super) prediction: ExactSum,
    /// Sum of the angles between true normals and the normal of a flat surface, degrees.
    pub(super) flat: ExactSum,
    /// Number of normals.
    pub(super) count: u64,
}

impl NormalAngles {
    /// Angles of all inner pixels that are valid in both maps together with their four neighbours.
    ///
    /// `pixel_mm` is the distance of neighbouring columns, then of neighbouring rows, in mm. Slopes are central differences.
    pub(super) fn of(truth: &DepthMap, prediction: &DepthMap, pixel_mm: [f64; 2]) -> NormalAngles {
        let mut angles = NormalAngles::default();
        let [rows, columns] = truth.size();
        for row in 1..rows.saturating_sub(1) {
            for column in 1..columns.saturating_sub(1) {
                let normals = [truth, prediction].map(|map| normal(map, row, column, pixel_mm));
                if let [Some(truth), Some(prediction)] = normals {
                    angles.prediction.add(angle(truth, prediction));
                    angles.flat.add(angle(truth, FLAT));
                    angles.count += 1;
                }
            }
        }
        angles
    }
}

/// Angle between two vectors, in degrees.
fn angle(one: [f64; 3], other: [f64; 3]) -> f64 {
    degrees(length(cross(one, other)), dot(one, other))
}

/// Normal of the surface at an inner pixel; `None` unless the pixel and its four neighbours are valid.
fn normal(map: &DepthMap, row: usize, column: usize, pixel_mm: [f64; 2]) -> Option<[f64; 3]> {
    let slope = |after: f64, before: f64, mm: f64| (after - before) / (2.0 * mm);
    let [x_mm, y_mm] = pixel_mm;
    let x = slope(map.at(row, column + 1), map.at(row, column - 1), x_mm);
    let y = slope(map.at(row + 1, column), map.at(row - 1, column), y_mm);
    let is_valid = !map.at(row, column).is_nan() && !x.is_nan() && !y.is_nan();
    is_valid.then_some([-x, -y, 1.0])
}
