//! Methods for intervals.

use super::bootstrap::PoissonBootstrap;

/// Method for the interval of a score. Both vary clusters: contact points, or samples that the caller takes as independent.
///
/// ```
/// use taceva_metrics::{IntervalMethod, PoissonBootstrap};
/// let method = IntervalMethod::PoissonBootstrap(PoissonBootstrap::DEFAULT);
/// assert_ne!(method, IntervalMethod::default());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum IntervalMethod {
    /// Leaves out one cluster after the other: the score is computed once more per cluster.
    #[default]
    Jackknife,
    /// Weights clusters at random, for skewed scores: the score is computed once per replicate.
    PoissonBootstrap(PoissonBootstrap),
}
