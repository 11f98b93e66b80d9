//! Note on too few clusters for any interval.

use std::fmt;

use taceva_core::{counted, shown};
use taceva_metrics::LEAST_CLUSTERS;
use taceva_models::{FoldGroups, FoldSpec};

/// Number of contact points or groups, which is too few for any interval. `Display` writes the sentence, with a remedy that applies.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct FewClusters {
    /// Groups that an interval would leave out.
    pub by: FoldGroups,
    /// Number of groups with scored samples.
    pub scored: usize,
    /// Number of groups in the dataset.
    pub all: usize,
    /// True if intervals would use contact points as clusters once the dataset names them.
    pub takes_points: bool,
}

impl fmt::Display for FewClusters {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.by {
            FoldGroups::Column(name) => {
                write!(
                    f,
                    "scored on {} of `{}`",
                    counted(self.scored, "group"),
                    shown(name)
                )
            }
            FoldGroups::Blocks => write!(f, "scored on {}", counted(self.scored, "block")),
            _ => write!(f, "scored on {}", counted(self.scored, "contact point")),
        }?;
        f.write_str(", too few for intervals")?;
        if self.all >= LEAST_CLUSTERS {
            let spec = FoldSpec {
                count: Some(LEAST_CLUSTERS),
                by: self.by.clone(),
            };
            return write!(f, "; to score all {}: --split '{spec}'", self.all);
        }
        write!(f, ", which need {LEAST_CLUSTERS}")?;
        match self.takes_points {
            true => f.write_str(
                "; for intervals over other groups, name their column as point_id under [ids] of the map",
            ),
            false => write!(f, "; the dataset has {}: record more", self.all),
        }
    }
}
