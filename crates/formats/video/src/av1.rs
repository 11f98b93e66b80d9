//! AV1 of 8 bits and 4:2:0 by `rav1d`, in a confined child process alone: a panic in the library ends the process that it is in.
//!
//! Whoever runs `serve` is the child; [`Decoders::av1`](crate::Decoders::av1) names the program for it. The clip's packets go in by its standard input, pictures
//! come out by its standard output, and that is all that it can do once it has begun (on Linux: it opens nothing, starts nothing, and has
//! the memory that such frames take; elsewhere it is merely another process).

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
