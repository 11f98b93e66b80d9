//! Structure figures of the workspace: lines, module cycles, tuple parameters, copies, doc comments, file names, files that mention one feature, and
//! crates that one package needs.
//!
//! `cargo run -p taceva-tests --bin structure` prints these figures; tests limit figures that must not grow.

mod copies;
mod crates;
mod documentation;
mod file_names;
mod knots;
mod lines;
mod mentions;
mod sources;
mod tuples;
mod walk;

pub use copies::{COPIES, Copies, copies};
pub use crates::compiled_crates;
pub use documentation::{Documentation, documentation};
pub use file_names::files_named_by_participles;
pub use knots::{knots, module_graph};
pub use lines::{Lines, lines};
pub use mentions::{EXAMPLES, Example, mentions};
pub use sources::{Source, sources, without_test_items};
pub use tuples::tuple_parameters;
pub use walk::{Walk, walks};
