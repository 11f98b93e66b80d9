//! Least numbers of clusters, replicates and samples.

/// Least number of clusters from which an interval is computed.
pub const LEAST_CLUSTERS: usize = 5;
/// Least number of bootstrap replicates for the ends of a 95 % interval.
pub(crate) const LEAST_REPLICATES: usize = 39;
/// Least number of samples of a bin or cell that counts in the variant `n_min_5`. The published definition requires only one sample.
pub(crate) const WELL_SAMPLED: u64 = 5;
