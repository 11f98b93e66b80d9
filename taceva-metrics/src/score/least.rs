//! Least numbers for an interval.

/// Least clusters for an interval.
pub const LEAST_CLUSTERS: usize = 5;
/// Least replicates, so that the ends of a 95 % interval are among them.
pub(crate) const LEAST_REPLICATES: usize = 39;
