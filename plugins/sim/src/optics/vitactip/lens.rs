//! Lens of the camera on the dome's axis.

use super::spec::VitactipSpec;

/// An equidistant lens. A point at the angle α from the axis appears α/α_rim radii of the rim from the centre. The rim has the angle α_rim.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lens {
    /// Distance between the camera and the dome's centre.
    behind_mm: f64,
    distance_mm: f64,
    rim_angle: f64,
}

impl Lens {
    pub(super) fn new(spec: &VitactipSpec) -> Lens {
        let behind_mm = spec.camera_distance_mm - spec.dome_radius_mm;
        Lens {
            behind_mm,
            distance_mm: spec.camera_distance_mm,
            // The rim is in the plane of the dome's centre.
            rim_angle: libm::atan2(spec.dome_radius_mm, behind_mm),
        }
    }

    /// Image of `point`, in radii of the rim. The point is in mm from the dome's centre.
    pub(super) fn project(&self, point: [f64; 3]) -> [f64; 2] {
        let [x, y, z] = point;
        let from_axis = (x * x + y * y).sqrt();
        let angle = libm::atan2(from_axis, z + self.behind_mm);
        let scale = if from_axis > 0.0 {
            angle / (self.rim_angle * from_axis)
        } else {
            0.0
        };
        [x * scale, y * scale]
    }

    /// Point that has the image `seen`, on a plane perpendicular to the axis, `depth_mm` nearer to the camera than the apex.
    pub(super) fn on_plane(&self, seen: [f64; 2], depth_mm: f64) -> [f64; 2] {
        let [x, y] = seen;
        let from_middle = (x * x + y * y).sqrt();
        if from_middle <= 0.0 {
            return [0.0, 0.0];
        }
        let from_axis = (self.distance_mm - depth_mm) * libm::tan(from_middle * self.rim_angle);
        [x, y].map(|part| part / from_middle * from_axis)
    }

    /// Image scale at `point`: radii of the rim per mm across the line of sight.
    pub(super) fn scale(&self, point: [f64; 3]) -> f64 {
        let [x, y, z] = point;
        let z = z + self.behind_mm;
        1.0 / (self.rim_angle * (x * x + y * y + z * z).sqrt())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::parameters::{Body, Model};

    fn spec() -> VitactipSpec {
        let parameters = Model::ViTacTip.parameters();
        let Body::Dome(dome) = parameters.body else {
            panic!("a dome");
        };
        VitactipSpec::new(&parameters, &dome)
    }

    fn lens() -> Lens {
        Lens::new(&spec())
    }

    #[test]
    fn the_rim_is_seen_one_radius_away_and_the_apex_in_the_middle() {
        let [x, y] = lens().project([0.0, -20.0, 0.0]);
        assert!(x.abs() < 1e-12 && (y + 1.0).abs() < 1e-12);
        assert!(lens().project([0.0, 0.0, 20.0])[0].abs() < 1e-12);
    }

    #[test]
    fn a_plane_is_seen_where_its_points_are_projected() {
        let depth = 1.5;
        let point = lens().on_plane([0.21, -0.13], depth);
        let seen = lens().project([point[0], point[1], 20.0 - depth]);
        assert!((seen[0] - 0.21).abs() < 1e-12 && (seen[1] + 0.13).abs() < 1e-12);
    }

    #[test]
    fn the_scale_is_that_of_a_small_step_across_the_line_of_sight() {
        let [from, to] = [0.0, 1e-4].map(|y| lens().project([0.0, y, 18.0])[1]);
        let scale = lens().scale([0.0, 0.0, 18.0]);
        assert!(((to - from) / 1e-4 - scale).abs() < 1e-6 * scale);
    }
}
