//! How an interval is found.

use super::bootstrap::PoissonBootstrap;

/// How the interval of a score is found. Either way the contact location is what varies, never the sample.
///
/// ```
/// use taceva_metrics::{IntervalMethod, PoissonBootstrap};
/// let method = IntervalMethod::PoissonBootstrap(PoissonBootstrap::DEFAULT);
/// assert_ne!(method, IntervalMethod::default());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum IntervalMethod {
    /// Leaving out one cluster after the other: one more finish a cluster.
    #[default]
    Jackknife,
    /// Weighting clusters at random: as many finishes as there are replicates, for scores whose distribution is skewed.
    PoissonBootstrap(PoissonBootstrap),
}
