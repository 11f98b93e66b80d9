//! Projects of the template: built, tested against the contract of their kind, and written by the published crate.

mod builds;
mod package;
