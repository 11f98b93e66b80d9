//! A ball in a gel: which force answers which displacement.
//!
//! Everything here is the truth of the bench, without noise. Forces and depths follow the signs of the project: positive into the gel
//! and in compression; tangential forces are those of the ball on the gel, along its displacement.

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

/// One state of contact, as it truly is; all zero where ball and gel do not touch.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contact {
    /// Where the ball's centre is, over the gel: the shear is part of it.
    pub position_mm: [f64; 2],
    /// How far the ball stands below the place where it would just touch, along the axis of the sensor.
    pub depth_mm: f64,
    /// How far it stands in the gel along the contact's normal; on a flat gel the same.
    pub normal_depth_mm: f64,
    /// The contact's normal: x, y and upwards, out of the gel.
    pub normal: [f64; 3],
    /// The direction in which the ball was displaced along the surface; zero if it was not.
    pub tangent: [f64; 3],
    /// How far along it the surface was carried; beyond that the ball slid.
    pub carried_mm: f64,
    /// How far the ball slid over the surface.
    pub slip_mm: f64,
    /// The contact radius a.
    pub radius_mm: f64,
    /// The radius within which nothing slips.
    pub stick_radius_mm: f64,
    /// The radius of the ball.
    pub indenter_radius_mm: f64,
    /// The modulus that the gel shows at this place, depth and time; on a dome that of the gel under the skin.
    pub young_modulus_mpa: f64,
    /// The share of the skin, rather than of the gel under it, in the normal force; 0 on a flat gel.
    pub skin_share: f64,
    /// Force along the normal.
    pub normal_force_n: f64,
    /// Force along the tangent.
    pub shear_force_n: f64,
    /// The force of the ball on the sensor: along x, along y, and into the gel along the sensor's axis.
    pub force_n: [f64; 3],
    /// How far the robot travelled after it had found contact, as commanded or, where the press was limited, as far as it came.
    pub travel_mm: f64,
    /// Whether the press stopped at the force limit before it reached its depth.
    pub limited: bool,
}

impl Contact {
    /// Whether ball and gel press on each other.
    pub fn touches(&self) -> bool {
        self.normal_force_n > 0.0
    }

    /// Whether the whole contact slides.
    pub fn slides(&self) -> bool {
        self.slip_mm > 0.0
    }

    /// What moves the points of a flat gel.
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
