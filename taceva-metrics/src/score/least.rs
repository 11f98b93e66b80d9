//! Least numbers for an interval, and of samples.

/// Least clusters for an interval.
pub const LEAST_CLUSTERS: usize = 5;
/// Least replicates, so that the ends of a 95 % interval are among them.
pub(crate) const LEAST_REPLICATES: usize = 39;
/// Least samples of a bin or cell for the variant `n_min_5`; the paper's least is one.
pub(crate) const WELL_SAMPLED: u64 = 5;
