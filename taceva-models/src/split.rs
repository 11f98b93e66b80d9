//! Which samples a model learns from, which settings are chosen by, and which it is tested on.

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
