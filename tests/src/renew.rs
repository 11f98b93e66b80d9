//! Numbers in documents: who wrote them, whether they still come out, and how they are renewed.
//!
//! A passage of a Markdown file that a command wrote stands between two comments, which a reader never sees:
//!
//! ```text
//! <!-- from: taceva catalogue list --format md -->
//! …
//! <!-- end -->
//! ```
//!
//! The command is run by `bash` in the folder of the workspace; its standard output is the passage. `$OUT` is an empty folder that the commands
//! of one document share, in order. `from, slow:` takes longer than a test may, `from, times:` is never twice the same, `from, data:` reads
//! the recordings of `TACEVA_DATA`: these three are renewed, and compared by `renew --check` where that makes sense. A table of numbers that no
//! command wrote says why before it: `<!-- by hand: … -->`.

mod documents;
mod mark;
mod passage;
mod runner;

pub use documents::{Document, documents};
pub use mark::{Kind, Mark, MarkError};
pub use passage::{Passage, unexplained_tables};
pub use runner::{Difference, Runner, RunnerError};
