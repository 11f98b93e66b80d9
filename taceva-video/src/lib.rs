#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod avi;
mod clip;
mod colour;
mod error;
mod h264;
mod jpeg;
mod limits;
mod mp4;
mod packets;
mod reorder;
mod source;
mod video;

pub use clip::{Colours, Picture, VideoInfo};
pub use error::{VideoError, VisitError};
pub use video::{Decoders, Video};
