//! ROS 1 and 2 messages: definitions, encodings and readers.

mod cdr;
mod definitions;
mod fields;
mod picture;
mod schema;

pub(crate) use definitions::known_definition;
pub(crate) use fields::{Fields, names, seconds};
pub use picture::{Picture, SampleForm, Samples};
pub(crate) use picture::{PictureField, RawPicture};
pub(crate) use schema::{Dialect, RosSchema};
