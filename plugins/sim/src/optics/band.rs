//! A band of rows of a picture during rendering.

use std::ops::Range;

/// Rows of light in DN, pixel by pixel, with the colours of a pixel side by side.
#[derive(Debug)]
pub(super) struct Band<'a> {
    /// First row of the band in the frame.
    pub(super) first_row: usize,
    /// Width, pixels.
    pub(super) width: usize,
    /// Colours of a pixel: 1 or 3.
    pub(super) channels: usize,
    /// Light, row by row.
    pub(super) light: &'a mut [f32],
}

impl Band<'_> {
    /// Rows of the frame in the band.
    pub(super) fn rows(&self) -> Range<usize> {
        let rows = self.light.len() / (self.width * self.channels);
        self.first_row..self.first_row + rows
    }

    /// Intersection of `rows` with the band.
    pub(super) fn rows_among(&self, rows: Range<usize>) -> Range<usize> {
        let own = self.rows();
        let first = rows.start.max(own.start);
        first..rows.end.min(own.end).max(first)
    }

    /// Light of row `position` of the band, counted from its first row.
    pub(super) fn row_mut(&mut self, position: usize) -> &mut [f32] {
        let length = self.width * self.channels;
        &mut self.light[position * length..][..length]
    }
}
