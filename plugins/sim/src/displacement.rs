//! Where the points of a gel go under a press: radial tables, made once a sensor, looked up a pixel at a time.
//!
//! The pressure is Hertz's over the contact radius a, the shear a no-slip one, q = Q/(2π a √(a² − r²)); both meet the bonded layer's
//! [`Kernel`](crate::elastic::kernel::Kernel) in a Hankel integral. What does not depend on the depth below the surface is scaled out,
//! so one [`Tables`] serves every force, modulus and place; a [`Profile`] is its row for one press, a [`Field`] that row put in place.
//!
//! With r the place relative to the contact's centre, s the unit vector of the shear and r² = r·r, a profile gives
//!
//! * along the surface: r·outward + s·along − r (r·s)·radial,
//! * upwards: −sink + (r·s)·bulge, with the gradient −r·sink_slope + s·bulge + r (r·s)·bulge_slope.
//!
//! Each factor is a function of r² alone: no square root and no trigonometric function a pixel.

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
