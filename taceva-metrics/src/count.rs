//! Counts as numbers of double precision.

pub(crate) fn as_f64(count: u64) -> f64 {
    count as f64
}
