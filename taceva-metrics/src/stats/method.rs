//! Methods for intervals.

use super::bootstrap::PoissonBootstrap;

/// Method for the interval of a score, from its variation over clusters: contact points, or samples that the caller declares independent.
///
/// ```
/// use taceva_metrics::{IntervalMethod, PoissonBootstrap};
/// let method = IntervalMethod::PoissonBootstrap(PoissonBootstrap::DEFAULT);
/// assert_ne!(method, IntervalMethod::default());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum IntervalMethod {
    /// Leaves out one cluster at a time and recomputes the score once per cluster.
    #[default]
    Jackknife,
    /// Gives clusters random weights, for skewed scores, and recomputes the score once per replicate.
    PoissonBootstrap(PoissonBootstrap),
}
