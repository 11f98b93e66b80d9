#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]

mod avi;
mod clip;
mod colour;
mod error;
mod ffmpeg;
mod h264;
mod jpeg;
mod limits;
mod matroska;
mod mp4;
mod packets;
mod process;
mod reorder;
mod source;
mod video;

pub use clip::{Colours, Picture, VideoInfo};
pub use error::{VideoError, VisitError};
pub use video::{Decoders, Video};
