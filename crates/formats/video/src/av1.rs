//! AV1 of 8 bits and 4:2:0. The library `rav1d` decodes AV1 only in a confined child process, so a panic in the library ends only that process.
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
