//! Least numbers of clusters, replicates and samples.

/// Least number of clusters for an interval.
pub const LEAST_CLUSTERS: usize = 5;
/// Least number of bootstrap replicates for the ends of a 95 % interval.
pub(crate) const LEAST_REPLICATES: usize = 39;
/// Least number of samples of a bin or cell for the variant `n_min_5`. The paper requires only one sample.
pub(crate) const WELL_SAMPLED: u64 = 5;
