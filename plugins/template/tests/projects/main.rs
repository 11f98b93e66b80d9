//! Projects of the template: built, tested for every promise, and written by the published crate.

mod builds;
mod package;
