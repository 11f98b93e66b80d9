#![doc = include_str!("../README.md")]

pub mod av1;
mod avi;
mod clip;
mod colour;
mod error;
mod ffmpeg;
mod gop;
mod h264;
mod jpeg;
mod limits;
mod matroska;
mod mp4;
mod packets;
mod presentation_order;
mod process;
mod source;
mod video;

pub use clip::{Colours, Picture, VideoInfo};
pub use error::{VideoError, VisitError};
pub use video::{Decoders, Video};
