//! Conversion of counts to `f64`.

pub(crate) fn as_f64(count: u64) -> f64 {
    count as f64
}
