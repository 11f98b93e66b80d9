//! Messages of ROS 2: their definitions, their encoding, and what is read of them.

mod cdr;
mod fields;
mod picture;
mod schema;

pub(crate) use fields::{Fields, names, seconds};
pub(crate) use picture::PictureField;
pub use picture::{Picture, SampleForm, Samples};
pub(crate) use schema::RosSchema;
