//! Decoder of AV1 clips with 8 bits per sample, gray or 4:2:0. The library `rav1d` runs only in a confined child process, so its panic ends only that
//! process.
//!
//! The child is a process that runs `serve`, and [`Decoders::av1`](crate::Decoders::av1) names its program. The child receives packets of the clip on
//! standard input and writes pictures to standard output. On Linux the child can do nothing else: it opens no file, starts no process, and its memory
//! is limited to what these frames need. On other systems it is an ordinary process.

#[cfg(feature = "av1")]
mod child;
mod parent;
#[cfg(feature = "av1")]
mod rav1d;
#[cfg(feature = "av1")]
mod sandbox;
mod wire;

#[cfg(feature = "av1")]
pub use child::{ServeError, serve};
pub(crate) use parent::{Av1Clip, DECODER};
