//! Which samples are learnt from, chosen by, and tested on.

mod assign;
mod error;
mod manifest;
mod spec;

pub use assign::{Part, Split, SplitInput};
pub use error::SplitError;
pub use manifest::{SplitCounts, SplitManifest};
pub use spec::{ColumnSplit, Fractions, SplitKind, SplitSpec};
