//! Displacement of the markers of a dome under a ball.

use super::spec::VitactipSpec;
use crate::contact::Contact;
use crate::elastic::{hertz, shell};
use crate::number::{count, narrow};
use taceva_core::whole_size;

/// Dimple of a shell as a table, because Kelvin's function for 127 markers would take longer than the picture.
#[derive(Clone, Debug)]
pub(super) struct Dimple {
    depths: Vec<f32>,
}

/// Number of nodes per decay length.
const NODES_A_LENGTH: f64 = 32.0;
/// End of the dimple, in decay lengths.
const LENGTHS: usize = 12;

impl Dimple {
    pub(super) fn new() -> Dimple {
        let nodes = 0..=32 * LENGTHS;
        Dimple {
            depths: nodes
                .map(|node| narrow(shell::dimple(count(node) / NODES_A_LENGTH)))
                .collect(),
        }
    }

    /// Depth at `arc` decay lengths from the load, relative to the depth under the load.
    fn at(&self, arc: f64) -> f64 {
        let place = arc * NODES_A_LENGTH;
        let node = whole_size(place).min(self.depths.len() - 2);
        let fraction = (place - count(node)).min(1.0);
        let [below, above] = [self.depths[node], self.depths[node + 1]].map(f64::from);
        below + fraction * (above - below)
    }
}

/// Displaced position of the marker at `marker`, in mm from the centre of the dome.
///
/// Let s be the distance from the contact along the surface, w the inward displacement there and d the indentation. With the decay length l of the
/// skin, the contact radius a and the normal n:
///
/// * w = d [f (−(4/π) kei(s/l)) + (1 − f) h(s/a)], f the share of the skin and h Hertz's profile, along −n;
/// * the skin follows the drag t by min(1, 1 / (0.35 + s / 1.6 a)) e^(−s / 18 mm) (free parameter);
/// * the whole dome leans with the lateral force, in proportion to the height.
pub(super) fn displaced(
    marker: [f64; 3],
    contact: &Contact,
    dimple: &Dimple,
    spec: &VitactipSpec,
) -> [f64; 3] {
    let normal = contact.normal;
    let from_contact: [f64; 3] =
        std::array::from_fn(|axis| marker[axis] - spec.dome_radius_mm * normal[axis]);
    let height = dot(from_contact, normal);
    let across: [f64; 3] = std::array::from_fn(|axis| from_contact[axis] - height * normal[axis]);
    let arc = dot(across, across).sqrt();
    let radius = contact.radius_mm.max(LEAST_RADIUS_MM);
    let shell = dimple.at(arc / spec.dimple_mm);
    let share = contact.skin_share;
    let sink =
        contact.normal_depth_mm * (share * shell + (1.0 - share) * hertz::profile(arc / radius));
    let follows = (1.0 / (0.35 + arc / (1.6 * radius))).min(1.0) * libm::exp(-arc / 18.0);
    let lean = spec.sway_mm_per_n * marker[2] / spec.dome_radius_mm;
    let [lean_x, lean_y] = [0, 1].map(|axis| lean * contact.force_n[axis]);
    let lean = [lean_x, lean_y, 0.0];
    std::array::from_fn(|axis| {
        marker[axis] - sink * normal[axis]
            + follows * contact.carried_mm * contact.tangent[axis]
            + lean[axis]
    })
}

/// Minimum apparent contact radius, mm. The thickness of the skin hides smaller contacts.
const LEAST_RADIUS_MM: f64 = 0.3;

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
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

    fn press() -> Contact {
        Contact {
            normal: [0.0, 0.0, 1.0],
            normal_depth_mm: 1.0,
            radius_mm: 1.35,
            skin_share: 0.3,
            normal_force_n: 0.1,
            ..Contact::default()
        }
    }

    fn displaced(marker: [f64; 3], contact: &Contact) -> [f64; 3] {
        super::displaced(marker, contact, &Dimple::new(), &spec())
    }

    #[test]
    fn the_marker_under_the_ball_goes_as_deep_as_the_ball() {
        let [x, y, z] = displaced([0.0, 0.0, 20.0], &press());
        assert!(x.abs() < 1e-12 && y.abs() < 1e-12);
        assert!((z - 19.0).abs() < 1e-6);
    }

    #[test]
    fn the_rim_stays_where_it_is() {
        let [x, y, z] = displaced([20.0, 0.0, 0.0], &press());
        assert!((x - 20.0).abs() < 1e-9 && y.abs() < 1e-12);
        // Hertz's profile decays like 1/r: 0.7 × 1.35/20 × (4/3π).
        assert!(z.abs() < 0.03, "{z}");
    }

    #[test]
    fn drag_and_lean_move_markers_their_way() {
        let load = Contact {
            tangent: [1.0, 0.0, 0.0],
            carried_mm: 0.5,
            force_n: [0.0, 0.25, 0.0],
            ..press()
        };
        let [x, y, _] = displaced([0.0, 0.0, 20.0], &load);
        assert!((x - 0.5).abs() < 1e-12);
        assert!((y - 0.2).abs() < 1e-12);
    }

    #[test]
    fn the_table_of_the_dimple_is_that_of_kelvins_function() {
        let dimple = Dimple::new();
        for arc in [0.0, 0.013, 0.4, 1.77, 5.02, 11.9] {
            assert!((dimple.at(arc) - shell::dimple(arc)).abs() < 3e-4, "{arc}");
        }
        assert!(dimple.at(1e9).abs() < 1e-3);
    }
}
