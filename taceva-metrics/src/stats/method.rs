//! How an interval is found.

use super::bootstrap::PoissonBootstrap;

/// How the interval of a score is found. Either way clusters vary: contact points, or samples where the caller takes them as independent.
///
/// ```
/// use taceva_metrics::{IntervalMethod, PoissonBootstrap};
/// let method = IntervalMethod::PoissonBootstrap(PoissonBootstrap::DEFAULT);
/// assert_ne!(method, IntervalMethod::default());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum IntervalMethod {
    /// Leaving out one cluster after the other: the score is finished once more per cluster.
    #[default]
    Jackknife,
    /// Weighting clusters at random, for scores whose distribution is skewed: the score is finished once per replicate.
    PoissonBootstrap(PoissonBootstrap),
}
