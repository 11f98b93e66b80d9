//! Contact of a ball with a gel: forces from displacements.
//!
//! All values are the truth of the bench, without noise. Depths and forces are positive into the gel and in compression. Tangential forces
//! act on the gel, along the displacement of the ball.

mod board;
mod dome_law;
mod friction;
mod indentation;
mod layer_law;
mod relaxation;
mod solid;
mod stand;
mod wear;

pub(crate) use board::SIDE_MM as BOARD_SIDE_MM;
pub use friction::Friction;
pub use indentation::Indentation;
pub use relaxation::{Decay, Relaxation};
pub use solid::{BoardStand, Solid};
pub use wear::{Conditioning, History, Wear};

use crate::displacement::Load;

/// True state of a contact; all zero without contact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contact {
    /// Position of the centre of the ball over the gel, including shear.
    pub position_mm: [f64; 2],
    /// Depth below first touch, along the axis of the sensor.
    pub depth_mm: f64,
    /// Depth along the contact normal; equal to `depth_mm` on a flat gel.
    pub normal_depth_mm: f64,
    /// Contact normal: x, y and upwards, out of the gel.
    pub normal: [f64; 3],
    /// Direction of the displacement along the surface; zero without displacement.
    pub tangent: [f64; 3],
    /// Displacement of the surface with the ball. The ball slides beyond this displacement.
    pub carried_mm: f64,
    /// Sliding distance of the ball over the surface.
    pub slip_mm: f64,
    /// Contact radius a.
    pub radius_mm: f64,
    /// Radius of the zone without slip, mm.
    pub stick_radius_mm: f64,
    /// Radius of the ball.
    pub indenter_radius_mm: f64,
    /// Effective modulus at this place, depth and time. On a dome: modulus of the gel under the skin.
    pub young_modulus_mpa: f64,
    /// Share of the skin in the normal force; 0 on a flat gel.
    pub skin_share: f64,
    /// Force along the normal.
    pub normal_force_n: f64,
    /// Force along the tangent.
    pub shear_force_n: f64,
    /// Force of the ball on the sensor: along x, along y, and into the gel along the sensor's axis.
    pub force_n: [f64; 3],
    /// Travel of the robot after first contact: the commanded travel, or less if the force limit stopped the press.
    pub travel_mm: f64,
    /// True if the force limit stopped the press before its depth.
    pub limited: bool,
}

impl Contact {
    /// True if the ball presses on the gel.
    pub fn touches(&self) -> bool {
        self.normal_force_n > 0.0
    }

    /// True if the whole contact slides.
    pub fn slides(&self) -> bool {
        self.slip_mm > 0.0
    }

    /// Load of the contact, as input for the displacements of a flat gel.
    pub fn load(&self) -> Load {
        Load {
            centre_mm: self.position_mm,
            contact_radius_mm: self.radius_mm,
            depth_mm: self.normal_depth_mm,
            indenter_radius_mm: self.indenter_radius_mm,
            young_modulus_mpa: self.young_modulus_mpa,
            normal_force_n: self.normal_force_n,
            shear_force_n: [0, 1].map(|axis| self.tangent[axis] * self.shear_force_n),
        }
    }
}
