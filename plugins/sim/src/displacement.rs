//! Displacement of the points of a gel under a press: radial tables, computed once per sensor and interpolated at each pixel.
//!
//! The pressure is Hertz's over the contact radius a. The shear stress of a contact without slip is Q/(2π a √(a² − r²)) for the shear force Q, at the
//! distance r from the centre. Both are convolved with the [`Kernel`](crate::elastic::kernel::Kernel) of the bonded layer in a Hankel integral. The
//! tables are independent of force, modulus and place, so that one [`Tables`] per depth suffices. A [`Profile`] contains the values for one press,
//! and a [`Field`] places a profile at a contact.
//!
//! Let r now be the place relative to the centre of the contact, s the unit vector of the shear and r² = r·r. The factors of a profile (outward,
//! along, radial, sink and bulge) give
//!
//! * along the surface: r·outward + s·along − r (r·s)·radial,
//! * upwards: −sink + (r·s)·bulge, with the gradient −r·sink_slope + s·bulge + r (r·s)·bulge_slope.
//!
//! Each factor depends only on r². A pixel therefore needs no square root and no trigonometric function.

mod field;
mod index;
mod load;
mod profile;
mod quadrature;
mod radial;
mod tables;

pub use field::Field;
pub use index::{NODES, Place, Radial, locate, node};
pub use load::Load;
pub use profile::Profile;
pub use radial::Quantity;
pub use tables::Tables;
