//! Counts as numbers of double precision.

pub(crate) fn as_f64(count: u64) -> f64 {
    #[expect(
        clippy::cast_precision_loss,
        reason = "constants and numbers of samples are far below 2^53"
    )]
    let count = count as f64;
    count
}
