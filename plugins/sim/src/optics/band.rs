//! A few rows of a picture while it is painted.

use std::ops::Range;

/// Rows of light in DN, colour after colour, pixel after pixel.
#[derive(Debug)]
pub(super) struct Band<'a> {
    /// The frame's row that is the band's first.
    pub(super) first_row: usize,
    /// Pixels a row.
    pub(super) width: usize,
    /// Numbers a pixel: 1 or 3.
    pub(super) channels: usize,
    /// The light, row by row.
    pub(super) light: &'a mut [f32],
}

impl Band<'_> {
    /// The frame's rows that lie in the band.
    pub(super) fn rows(&self) -> Range<usize> {
        let rows = self.light.len() / (self.width * self.channels);
        self.first_row..self.first_row + rows
    }

    /// Those of `rows` that lie in the band.
    pub(super) fn rows_among(&self, rows: Range<usize>) -> Range<usize> {
        let own = self.rows();
        let first = rows.start.max(own.start);
        first..rows.end.min(own.end).max(first)
    }

    /// The light of the band's row `position`, counted from its first.
    pub(super) fn row_mut(&mut self, position: usize) -> &mut [f32] {
        let length = self.width * self.channels;
        &mut self.light[position * length..][..length]
    }
}
