//! Closed forms of linear elasticity: a ball on a half-space, on a bonded layer, and on a shell.
//!
//! Lengths in mm, forces in N, moduli in MPa = N/mm². Depths and pressures are positive into the gel.

pub mod hertz;
pub mod kelvin;
pub mod kernel;
pub mod layer;
pub mod shell;
