//! Which samples are learnt from, chosen by, and tested on.

mod assign;
mod error;
mod fractions;
mod manifest;
mod part;
mod spec;

pub use assign::{Split, SplitInput};
pub use error::SplitError;
pub use fractions::Fractions;
pub use manifest::{SplitCounts, SplitManifest};
pub use part::Part;
pub use spec::{ColumnSplit, SplitKind, SplitSpec};
