//! Grid of equal panels, with gaps for axes.

use super::canvas::Canvas;
use super::panel::Area;

/// Width of the narrowest panel with enough room for its labels, in canvas units.
const NARROWEST: f64 = 96.0;
/// Ratio of height to width of the flattest panel after narrowing.
const FLATTEST: f64 = 0.62;

/// Equal panels in rows.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    first: Area,
    count: usize,
    columns: usize,
    rows: usize,
    gaps: [f64; 2],
}

impl Grid {
    /// Grid of `count` panels, at most `most` in a row. `first` is the upper left panel; `gaps` are the horizontal and vertical distances.
    pub(crate) fn new(count: usize, most: usize, first: Area, gaps: [f64; 2]) -> Grid {
        let columns = count.min(most).max(1);
        Grid {
            first,
            count,
            columns,
            rows: count.div_ceil(columns).max(1),
            gaps,
        }
    }

    /// Fits the grid to a canvas of the width `room`, with the margin `right` after the last panel of a row. Reduces the panels per row if panels
    /// would be too narrow. Panels keep their proportions, but are at least [`FLATTEST`] times as high as wide.
    #[must_use]
    pub(crate) fn within(self, room: Option<f64>, right: f64) -> Grid {
        let Some(room) = room else { return self };
        let width = |columns: usize| {
            let gaps = (columns - 1) as f64 * self.gaps[0];
            (room - self.first.left - right - gaps) / columns as f64
        };
        let mut columns = (1..=self.columns).rev();
        let columns = columns.find(|columns| width(*columns) >= NARROWEST);
        let columns = columns.unwrap_or(1);
        let width = width(columns).max(NARROWEST);
        let ratio = (self.first.height / self.first.width).max(FLATTEST);
        Grid {
            first: Area {
                width,
                height: width * ratio,
                ..self.first
            },
            columns,
            rows: self.count.div_ceil(columns).max(1),
            ..self
        }
    }

    /// Canvas and grid of `count` square maps, two in a row, each with a gap for a colour scale.
    pub(crate) fn of_maps(count: usize, room: Option<f64>) -> (Grid, Canvas) {
        let first = Area {
            left: 58.0,
            top: 34.0,
            width: 280.0,
            height: 280.0,
        };
        let grid = Grid::new(count, 2, first, [142.0, 82.0]).within(room, 78.0);
        (grid, grid.canvas([78.0, 42.0]))
    }

    /// Area of the panel at `position`, counted along the rows.
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
    fn panels_within_a_column_fill_it_and_stand_in_fewer_rows_of_more() {
        let first = Area {
            left: 58.0,
            top: 34.0,
            width: 216.0,
            height: 196.0,
        };
        let grid = Grid::new(6, 3, first, [66.0, 78.0]).within(Some(343.0), 16.0);
        assert_eq!((grid.columns, grid.rows), (2, 3));
        assert!((grid.canvas([16.0, 42.0]).width - 343.0).abs() < 1e-9);
        let narrow = Grid::new(6, 3, first, [66.0, 78.0]).within(Some(100.0), 16.0);
        assert!((narrow.area(0).width - NARROWEST).abs() < 1e-9);
    }

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
