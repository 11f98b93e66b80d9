//! Which samples are learnt from, chosen by, and tested on.

mod assign;
mod manifest;
mod spec;

pub use assign::{Part, Split, SplitError, SplitInput};
pub use manifest::{SplitCounts, SplitManifest};
pub use spec::{ColumnSplit, Fractions, SplitKind, SplitSpec};
