//! Pictures: what the camera inside a tactile sensor sees when something touches the gel.
//!
//! A [`Camera`] is one unit of one sensor at one frame size; it turns a [`View`] into a frame in the caller's buffer, and tells how
//! bright the frame is. Everything is in closed form and every picture is a function of its inputs alone.
//!
//! How a picture comes about, a few rows at a time:
//!
//! 1. copy the picture of the untouched gel, worked out once a camera;
//! 2. work out afresh the pixels near the contact, from radial tables by the square of the distance;
//! 3. darken the markers where they are now;
//! 4. add noise from a tile of normal numbers, round, clip, and add up the brightness.
//!
//! The pictures are simulated: parameters marked *fit* were chosen so that a figure of the paper comes out, those marked *free* have
//! no public evidence.

mod ambient;
mod band;
mod bits;
mod camera;
mod contrast;
mod disc;
mod error;
mod gel;
mod gelsight;
mod luma;
mod magictac;
mod noise;
mod raster;
mod readout;
mod relief;
mod simd;
mod spec;
mod stimulus;
mod texture;
mod view;
mod vitactip;

pub use ambient::AmbientLight;
pub use bits::Bits;
pub use camera::Camera;
pub use error::OpticsError;
pub use gelsight::{GelsightSpec, LampSpec, MarkerGrid};
pub use luma::Luma;
pub use magictac::MagictacSpec;
pub use spec::{CameraSpec, GelSpec, OpticsSpec};
pub use stimulus::{Board, Stimulus};
pub use view::View;
pub use vitactip::VitactipSpec;
