//! Depth maps as the mean depths of a few cells, which a model predicts.

/// Maximum number of cells along a side of a depth map.
const MOST_CELLS: usize = 24;

/// Grid of cells on depth maps of one size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Cells {
    /// Rows and columns of pixels.
    pixels: [usize; 2],
    /// Rows and columns of cells.
    grid: [usize; 2],
}

impl Cells {
    /// Grid on maps of `pixels` rows and columns.
    pub(super) fn of(pixels: [usize; 2]) -> Cells {
        Cells {
            pixels,
            grid: pixels.map(|side| side.min(MOST_CELLS)),
        }
    }

    /// Rows and columns of pixels.
    pub(super) fn pixels(self) -> [usize; 2] {
        self.pixels
    }

    /// Rows and columns of cells.
    pub(super) fn grid(self) -> [usize; 2] {
        self.grid
    }

    /// Number of cells.
    pub(super) fn count(self) -> usize {
        self.grid.iter().product()
    }

    /// Mean of the valid depths of each cell. A cell without a valid depth gets the mean of all valid depths. `None` for a map without a valid pixel.
    ///
    /// # Shapes
    /// `mm`: all pixels, row by row, NaN for an invalid pixel. Returns the cells row by row.
    pub(super) fn means(self, mm: &[f64]) -> Option<Vec<f64>> {
        let ([rows, columns], [down, across]) = (self.pixels, self.grid);
        let mut sums = vec![0.0_f64; self.count()];
        let mut counts = vec![0_u32; self.count()];
        for (row, pixels) in mm.chunks_exact(columns).enumerate() {
            let valid = pixels.iter().enumerate();
            for (column, depth) in valid.filter(|(_, depth)| !depth.is_nan()) {
                let cell = (row * down / rows) * across + column * across / columns;
                sums[cell] += depth;
                counts[cell] += 1;
            }
        }
        let valid: u32 = counts.iter().sum();
        let all = sums.iter().sum::<f64>() / f64::from(valid);
        let mean = |(sum, count): (&f64, &u32)| match count {
            0 => all,
            count => sum / f64::from(*count),
        };
        (valid > 0).then(|| sums.iter().zip(&counts).map(mean).collect())
    }

    /// Depths of all pixels, interpolated linearly between the centres of cells. Depths are constant beyond the outer centres.
    ///
    /// # Shapes
    /// `depths`: the cells row by row. Returns the pixels row by row.
    pub(super) fn map(self, depths: &[f64]) -> Vec<f64> {
        let ([rows, columns], [down, across]) = (self.pixels, self.grid);
        let places: Vec<Place> = (0..columns)
            .map(|column| Place::of(column, columns, across))
            .collect();
        let mut mm = Vec::with_capacity(rows * columns);
        for row in 0..rows {
            let y = Place::of(row, rows, down);
            let line = |at: usize| &depths[at * across..][..across];
            let (before, after) = (line(y.before), line(y.after));
            mm.extend(places.iter().map(|x| {
                let at = |line: &[f64]| x.mix(line[x.before], line[x.after]);
                y.mix(at(before), at(after))
            }));
        }
        mm
    }
}

/// Place of a pixel between the centres of two cells.
struct Place {
    before: usize,
    after: usize,
    /// Weight of the second cell in the interpolation, from 0 to 1.
    share: f64,
}

impl Place {
    /// Place of the pixel with index `pixel` in a row or column of `pixels` pixels, which is divided into `cells` cells.
    fn of(pixel: usize, pixels: usize, cells: usize) -> Place {
        // Distances from the centre of the first cell, in units in which a cell is twice `pixels` long.
        let cell = 2 * pixels;
        let distance = ((2 * pixel + 1) * cells).saturating_sub(pixels);
        let before = distance / cell;
        Place {
            before,
            after: (before + 1).min(cells - 1),
            share: (distance % cell) as f64 / cell as f64,
        }
    }

    fn mix(&self, before: f64, after: f64) -> f64 {
        before + (after - before) * self.share
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_map_is_its_own_cells() {
        let cells = Cells::of([2, 3]);
        let map = vec![0.5, 0.25, 0.125, 0.0, -1.0, 2.0];
        assert_eq!(cells.means(&map).as_ref(), Some(&map));
        assert_eq!(cells.map(&map), map);
    }

    #[test]
    fn a_plane_in_a_larger_map_is_found_between_the_outer_centres() {
        let [rows, columns] = [48, 96];
        let pixels = (0..rows * columns).map(|at| (at / columns) as f64 - (at % columns) as f64);
        let plane: Vec<f64> = pixels.collect();
        let cells = Cells::of([rows, columns]);
        assert_eq!(cells.grid(), [24, 24]);
        let means = cells.means(&plane).expect("valid pixels");
        let found = cells.map(&means);
        for row in 1..rows - 1 {
            for column in 2..columns - 2 {
                let at = row * columns + column;
                let error = (found[at] - plane[at]).abs();
                assert!(error < 1e-9, "{row}, {column}: {error}");
            }
        }
    }

    #[test]
    fn a_cell_without_a_valid_pixel_has_the_mean_of_the_others() {
        let cells = Cells::of([1, 3]);
        let means = cells.means(&[1.0, f64::NAN, 2.0]);
        assert_eq!(means, Some(vec![1.0, 1.5, 2.0]));
        assert_eq!(cells.means(&[f64::NAN; 3]), None);
    }
}
