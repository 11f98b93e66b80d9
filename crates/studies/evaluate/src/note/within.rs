//! Groups of a split within larger groups.

use std::fmt;

use taceva_core::shown;
use taceva_metrics::LEAST_CLUSTERS;
use taceva_models::{FoldGroups, FoldSpec};

/// Groups of a split, such as grasps, that are within larger groups, such as objects. `Display` writes the sentence, with the split that leaves out the larger
/// groups.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Within {
    /// Column of the split.
    pub column: String,
    /// Column of the larger groups.
    pub within: String,
    /// Number of groups of the split that have other groups in the same larger group.
    pub shared: usize,
    /// Number of groups of the split.
    pub of: usize,
    /// Number of larger groups.
    pub larger: usize,
}

impl fmt::Display for Within {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let spec = FoldSpec {
            count: (self.larger >= LEAST_CLUSTERS).then_some(LEAST_CLUSTERS),
            by: FoldGroups::Column(self.within.clone()),
        };
        write!(
            f,
            "{} of {} groups of `{}` share their `{within}` with others, so training and test samples may have the same `{within}`; \
             to keep each `{within}` in one part: --split '{spec}'",
            self.shared,
            self.of,
            shown(&self.column),
            within = shown(&self.within)
        )
    }
}
