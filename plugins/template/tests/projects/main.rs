//! The projects that the template writes: built, held to every promise, and written by the crate as it is published.

mod builds;
mod package;
