//! Generated numbers in documents: their commands, checks and renewal.
//!
//! A generated passage of a Markdown file is between two comments, which readers do not see:
//!
//! ```text
//! <!-- from: taceva catalogue list --format md -->
//! …
//! <!-- end -->
//! ```
//!
//! `bash` runs the command in the workspace folder, and its standard output is the passage. `$OUT` is an empty folder that the commands of one
//! document share, in order. `from, slow:` marks a command that takes too long for a test. `from, times:` marks a command whose output varies. `from,
//! data:` marks a command that reads the recordings of `TACEVA_DATA`. `renew` writes all kinds again, and `renew --check` compares them if possible.
//! A handwritten table of numbers is preceded by its reason: `<!-- by hand: … -->`.

mod documents;
mod mark;
mod passage;
mod runner;

pub use documents::{Document, documents};
pub use mark::{Kind, Mark, MarkError};
pub use passage::{Passage, unexplained_tables};
pub use runner::{Difference, Runner, RunnerError};
