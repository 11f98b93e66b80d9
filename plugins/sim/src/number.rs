//! Number casts for displacements and pictures.

/// Converts a binary64 value for a table or a picture.
#[expect(
    clippy::cast_possible_truncation,
    reason = "displacements and pictures need seven digits"
)]
#[inline]
pub(crate) fn narrow(value: f64) -> f32 {
    value as f32
}

/// Converts a count to a number.
#[inline]
pub(crate) fn count(things: usize) -> f64 {
    things as f64
}
