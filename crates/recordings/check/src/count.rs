//! Conversion of counts to double precision.

#[expect(clippy::cast_precision_loss, reason = "counts are far below 2^53")]
pub(crate) fn count(number: usize) -> f64 {
    number as f64
}
