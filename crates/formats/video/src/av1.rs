//! AV1 of 8 bits and 4:2:0, decoded by `rav1d` only in a confined child process. A panic in the library ends its process.
//!
//! The process that runs `serve` is the child. [`Decoders::av1`](crate::Decoders::av1) names its program. Packets of the clip arrive on
//! its standard input, and pictures leave on its standard output. On Linux it can do nothing else: it opens no file, starts no process,
//! and has memory only for such frames. On other systems it is an ordinary process.

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
