//! Equal panels in rows, with room for axes between them.

use super::canvas::Canvas;
use super::panel::Area;

/// Equal panels in rows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    first: Area,
    columns: usize,
    rows: usize,
    gaps: [f64; 2],
}

impl Grid {
    /// Grid of `count` panels of the size of `first`, the upper left one, at most `most` per row. `gaps` are the horizontal and vertical
    /// distances.
    pub(crate) fn new(count: usize, most: usize, first: Area, gaps: [f64; 2]) -> Grid {
        let columns = count.min(most).max(1);
        Grid {
            first,
            columns,
            rows: count.div_ceil(columns).max(1),
            gaps,
        }
    }

    /// Grid of `count` square maps, two per row, each with room for a colour scale, and its canvas.
    pub(crate) fn of_maps(count: usize) -> (Grid, Canvas) {
        let first = Area {
            left: 58.0,
            top: 34.0,
            width: 280.0,
            height: 280.0,
        };
        let grid = Grid::new(count, 2, first, [142.0, 82.0]);
        (grid, grid.canvas([78.0, 42.0]))
    }

    /// Area of the panel at `position`, counted along the rows.
    #[expect(clippy::cast_precision_loss, reason = "a handful of rows and columns")]
    pub(crate) fn area(&self, position: usize) -> Area {
        let (row, column) = (position / self.columns, position % self.columns);
        let Grid { first, gaps, .. } = *self;
        Area {
            left: first.left + column as f64 * (first.width + gaps[0]),
            top: first.top + row as f64 * (first.height + gaps[1]),
            ..first
        }
    }

    /// Canvas for all panels, with margins to the right and below.
    pub(crate) fn canvas(&self, [right, below]: [f64; 2]) -> Canvas {
        let last = self.area(self.rows * self.columns - 1);
        Canvas::new(last.right() + right, last.bottom() + below)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_row_that_is_not_full_is_as_wide_as_the_others() {
        let first = Area {
            left: 10.0,
            top: 20.0,
            width: 100.0,
            height: 50.0,
        };
        let grid = Grid::new(3, 2, first, [5.0, 7.0]);
        let third = grid.area(2);
        assert_eq!(
            [third.left, third.top].map(f64::to_bits),
            [10.0, 77.0].map(f64::to_bits)
        );
        let canvas = grid.canvas([1.0, 2.0]);
        let size = [canvas.width, canvas.height].map(f64::to_bits);
        assert_eq!(size, [216.0, 129.0].map(f64::to_bits));
    }
}
