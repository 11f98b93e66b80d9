//! Conversion of counts to double precision.

pub(crate) fn count(number: usize) -> f64 {
    number as f64
}
