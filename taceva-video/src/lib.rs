#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod avi;
mod clip;
mod error;
mod jpeg;
mod limits;
mod packets;
mod source;
mod video;

pub use clip::{Colours, Picture, VideoInfo};
pub use error::{VideoError, VisitError};
pub use video::{Decoders, Video};
