//! Pictures: the view of the camera in a tactile sensor.
//!
//! A [`Camera`] is one unit of one sensor at one frame size. It renders a [`View`] into a frame in the caller's buffer, and returns the brightness of
//! the frame. All formulas are in closed form, and a picture depends only on its inputs.
//!
//! Steps of a picture, a few rows at a time:
//!
//! 1. copy the picture of the untouched gel, computed once per camera;
//! 2. recompute the pixels near the contact, from radial tables indexed by the squared distance;
//! 3. darken the markers at their present places;
//! 4. add noise from a tile of normal numbers, round, clip, and sum the brightness.
//!
//! The pictures are simulated. Parameters marked *fit* reproduce a figure of the paper; those marked *free* have no public evidence.

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
mod marks;
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
