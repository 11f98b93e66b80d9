//! Findings on neighbouring samples, and the division of these samples.

use std::fmt;

use taceva_core::{counted, shown};
use taceva_models::FoldGroups;
use taceva_results::OPTIMISTIC;

/// Order that defines neighbouring samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleOrder {
    /// Order by time.
    Time,
    /// Order of the rows in the table.
    Table,
}

/// Findings on neighbouring samples that resemble each other.
#[derive(Clone, Debug, PartialEq)]
pub struct Neighbours {
    /// Name of the channel whose neighbours resemble each other most.
    pub channel: String,
    /// One minus the ratio of the mean squared rank difference of neighbours to that of random pairs: 0 for independent, 1 for equal neighbours.
    pub resemblance: f64,
    /// Distance, in samples, at which two samples hardly resemble each other.
    pub lag: usize,
    /// Order that defines neighbours.
    pub order: SampleOrder,
    /// Column whose values are groups of neighbours; `None` for blocks of time.
    pub column: Option<String>,
}

/// Division of neighbouring samples that resemble each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Division {
    /// Blocks of time are not separated.
    Blocks {
        /// Number of blocks.
        count: usize,
        /// Number of samples left out between blocks of different parts.
        gap: usize,
    },
    /// Samples with the same value in this column are not separated.
    Column(String),
    /// Neighbours are separated, as the caller requested, although many tested samples have a neighbour in the training part.
    Separated {
        /// Number of tested samples with a neighbour in the training part.
        beside: usize,
        /// Number of tested samples.
        of: usize,
    },
}

/// Reasons to treat samples as independent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Independence {
    /// The caller states that samples are independent.
    Stated,
    /// Points are not named, and neighbours do not resemble each other.
    Found {
        /// True if the labels contain positions.
        has_places: bool,
    },
}

impl fmt::Display for Neighbours {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let order = match self.order {
            SampleOrder::Time => "in time",
            SampleOrder::Table => "in the table",
        };
        write!(
            f,
            "neighbours {order} resemble each other ({} by {:.2}, where 1 is equal and 0 independent)",
            self.channel, self.resemblance
        )
    }
}

/// Writes the findings and the division as one sentence.
pub(super) fn write(
    found: &Neighbours,
    division: &Division,
    f: &mut fmt::Formatter<'_>,
) -> fmt::Result {
    write!(f, "{found}")?;
    match division {
        Division::Blocks { count, gap } => write!(
            f,
            ", so {count} blocks of time stay together, with a gap of {} between training and test blocks",
            counted(*gap, "sample")
        ),
        Division::Column(name) => {
            write!(f, ", so samples with equal `{}` stay together", shown(name))
        }
        Division::Separated { beside, of } => write!(
            f,
            ", and {beside} of {of} test samples have a neighbour in the training part: {OPTIMISTIC}; divide with --split \
             'cv:5 {}'",
            match &found.column {
                Some(name) => FoldGroups::Column(name.clone()),
                None => FoldGroups::Blocks,
            }
        ),
    }
}
