//! Splits of samples into training, validation and test parts.

mod assign;
mod error;
mod fold_spec;
mod folds;
mod fractions;
mod input;
mod manifest;
mod part;
mod spec;

pub use assign::Split;
pub use error::SplitError;
pub use fold_spec::{FoldGroups, FoldSpec};
pub use folds::Folds;
pub use fractions::Fractions;
pub use input::{SplitBlocks, SplitInput};
pub use manifest::{SplitCounts, SplitManifest};
pub use part::Part;
pub use spec::{ColumnSplit, SplitKind, SplitSpec};
