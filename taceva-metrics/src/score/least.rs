//! How much there must be for an interval.

/// Clusters below which there is no interval.
pub(crate) const LEAST_CLUSTERS: usize = 5;
/// Replicates below which the ends of an interval of 95 % are not among them.
pub(crate) const LEAST_REPLICATES: usize = 39;
