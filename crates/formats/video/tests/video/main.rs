//! Tests with clips of every container: frames as another decoder gives them, and damaged copies.

#[cfg(feature = "av1")]
mod av1;
mod avi;
mod ffmpeg;
mod mp4;
mod support;
