//! Grid of the cells of a surface.

use taceva_core::{Footprint, Nanometre};

/// Square grid of cells over the smallest rectangle that encloses a footprint.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Grid {
    footprint: Footprint,
    bins: u32,
}

/// Row and column of a cell.
pub(crate) type Cell = (u32, u32);

impl Grid {
    pub(crate) fn new(footprint: Footprint, bins: u32) -> Grid {
        Grid { footprint, bins }
    }

    /// Row and column of the cell at a place in mm, computed in whole nanometres; `None` outside the footprint.
    ///
    /// For G cells from −R to R along an axis, the coordinate x is in cell min(⌊(x + R) G / 2R⌋, G − 1). The last edge belongs to the last cell.
    pub(crate) fn cell(&self, x_mm: f64, y_mm: f64) -> Option<Cell> {
        let x = Nanometre::from_millimetres(x_mm)?;
        let y = Nanometre::from_millimetres(y_mm)?;
        if !self.footprint.contains(x, y) {
            return None;
        }
        let [half_x, half_y] = self.footprint.half_extent();
        Some((self.bin(y, half_y), self.bin(x, half_x)))
    }

    fn bin(&self, place: Nanometre, half: Nanometre) -> u32 {
        let from_edge = i128::from(place.0) + i128::from(half.0);
        let bin = from_edge * i128::from(self.bins) / (2 * i128::from(half.0));
        let bin =
            u32::try_from(bin).expect("a place within the footprint is at or right of its edge");
        bin.min(self.bins - 1)
    }

    /// Edges of the columns and edges of the rows, mm. Each edge is rounded once.
    pub(crate) fn edges_mm(&self) -> [Vec<f64>; 2] {
        self.footprint.half_extent().map(|half| {
            let edge = |bin: u32| {
                let bins = i64::from(self.bins);
                let numerator = half.0 * (2 * i64::from(bin) - bins);
                as_f64(numerator) / as_f64(bins * 1_000_000)
            };
            (0..=self.bins).map(edge).collect()
        })
    }

    /// Number of cells along each side.
    pub(crate) fn bins(&self) -> u32 {
        self.bins
    }

    /// Footprint that the grid covers.
    pub(crate) fn footprint(&self) -> Footprint {
        self.footprint
    }
}

fn as_f64(value: i64) -> f64 {
    value as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid() -> Grid {
        Grid::new(Footprint::rectangle(12.5, 5.0, None).expect("lengths"), 20)
    }

    #[test]
    fn an_edge_belongs_to_the_cell_right_of_it_and_the_last_to_the_last() {
        let cell = |x, y| grid().cell(x, y);
        assert_eq!(cell(-12.5, -5.0), Some((0, 0)));
        assert_eq!(cell(12.5, 5.0), Some((19, 19)));
        assert_eq!(cell(-11.25, 0.0), Some((10, 1)));
        assert_eq!(cell(-11.250_001, -0.000_001), Some((9, 0)));
        assert_eq!(cell(12.500_001, 0.0), None);
        assert_eq!(cell(f64::MAX, 0.0), None);
    }

    #[test]
    fn the_corners_of_a_disc_lie_outside() {
        let grid = Grid::new(Footprint::disc(10.0, None).expect("a length"), 20);
        assert_eq!(grid.cell(8.0, 8.0), None);
        assert_eq!(grid.cell(7.0, 7.0), Some((17, 17)));
    }

    #[test]
    fn edges_are_the_decimals_they_should_be() {
        let [x, y] = grid().edges_mm();
        assert_eq!((x.len(), x[1], x[20]), (21, -11.25, 12.5));
        assert_eq!((y[0], y[10], y[19]), (-5.0, 0.0, 4.5));
    }
}
