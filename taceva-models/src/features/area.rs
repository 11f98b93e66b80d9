//! Exact averages of pixels over the areas of grid cells.

use taceva_core::{Frame, FrameInfo};

/// Overlap of `target` cells with `source` pixels along one axis. Lengths are whole units: a cell has `cell` units, a pixel `pixel` units.
#[derive(Clone, Debug)]
struct Axis {
    spans: Vec<Span>,
    pixel: u32,
    cell: u32,
}

/// Pixels that one cell covers along an axis: a range of whole pixels, and a partly covered pixel at each end.
#[derive(Clone, Debug, PartialEq, Eq)]
struct Span {
    whole: std::ops::Range<usize>,
    before: Option<PartialPixel>,
    after: Option<PartialPixel>,
}

/// Pixel that the cell covers only by `units` units of its length.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct PartialPixel {
    pixel: usize,
    units: u32,
}

impl Axis {
    /// Computes the overlap of `target` cells with `source` pixels. `source` must be at least `target`, and both must be positive.
    fn new(source: u32, target: u32) -> Axis {
        let divisor = greatest_common_divisor(source, target);
        let (cell, pixel) = (source / divisor, target / divisor);
        let part = |position: u64, units: u64| PartialPixel {
            pixel: usize::try_from(position).expect("a pixel of a frame in memory"),
            units: u32::try_from(units).expect("fewer units than a pixel has"),
        };
        let spans = (0..u64::from(target))
            .map(|index| {
                let (start, end) = (index * u64::from(cell), (index + 1) * u64::from(cell));
                let pixel = u64::from(pixel);
                let (first_whole, after_whole) = (start.div_ceil(pixel), end / pixel);
                let before = first_whole * pixel - start;
                let after = end - after_whole * pixel;
                Span {
                    whole: part(first_whole, 0).pixel..part(after_whole, 0).pixel,
                    before: (before > 0).then(|| part(first_whole - 1, before)),
                    after: (after > 0).then(|| part(after_whole, after)),
                }
            })
            .collect();
        Axis { spans, pixel, cell }
    }
}

fn greatest_common_divisor(a: u32, b: u32) -> u32 {
    if b == 0 {
        a
    } else {
        greatest_common_divisor(b, a % b)
    }
}

/// Sums the pixels of a frame over the cells of a coarser grid. Partly covered pixels count by their covered area. All sums are exact integers.
#[derive(Clone, Debug)]
pub(super) struct AreaSums {
    rows: Axis,
    columns: Axis,
    info: FrameInfo,
}

impl AreaSums {
    /// Maximum number of rows of a frame. The sum over a column of 65,535 pixels of 16 bits still fits into 32 bits.
    pub(super) const ROWS_MAX: u32 = 65_535;

    /// Prepares sums for frames of `info` and a grid of `width` × `height` cells. The grid must have no more cells than the frame has pixels, along
    /// each side.
    pub(super) fn new(info: FrameInfo, width: u32, height: u32) -> AreaSums {
        AreaSums {
            rows: Axis::new(info.height, height),
            columns: Axis::new(info.width, width),
            info,
        }
    }

    /// Sum over one cell if every pixel has the greatest possible value.
    pub(super) fn full_scale(&self) -> u64 {
        u64::from(self.rows.cell)
            * u64::from(self.columns.cell)
            * u64::from(self.info.format.full_scale())
    }

    /// Calls `take` once per cell, row by row. Gray frames have one sum per cell, RGB frames one per colour.
    pub(super) fn for_each(&self, frame: &Frame, mut take: impl FnMut(&[u64])) {
        let samples = self.info.format.samples();
        let row_samples = self.info.width as usize * samples;
        let mut column_sums = vec![0_u32; row_samples];
        for span in &self.rows.spans {
            self.sum_rows(frame.bytes(), span, &mut column_sums);
            match samples {
                1 => self.sum_columns::<1>(&column_sums, &mut take),
                _ => self.sum_columns::<3>(&column_sums, &mut take),
            }
        }
    }

    fn sum_rows(&self, bytes: &[u8], span: &Span, sums: &mut [u32]) {
        let width = self.info.format.bytes_per_sample();
        let row_bytes = sums.len() * width;
        let row = |index: usize| &bytes[index * row_bytes..(index + 1) * row_bytes];
        sums.fill(0);
        for index in span.whole.clone() {
            add_row(sums, row(index), width, 1);
        }
        if self.rows.pixel > 1 {
            sums.iter_mut().for_each(|sum| *sum *= self.rows.pixel);
        }
        for part in [span.before, span.after].into_iter().flatten() {
            add_row(sums, row(part.pixel), width, part.units);
        }
    }

    fn sum_columns<const SAMPLES: usize>(&self, sums: &[u32], take: &mut impl FnMut(&[u64])) {
        let (pixels, _) = sums.as_chunks::<SAMPLES>();
        for span in &self.columns.spans {
            let mut cell = [0_u64; SAMPLES];
            for pixel in &pixels[span.whole.clone()] {
                for (total, &sum) in cell.iter_mut().zip(pixel) {
                    *total += u64::from(sum);
                }
            }
            cell.iter_mut()
                .for_each(|total| *total *= u64::from(self.columns.pixel));
            for part in [span.before, span.after].into_iter().flatten() {
                for (total, &sum) in cell.iter_mut().zip(&pixels[part.pixel]) {
                    *total += u64::from(sum) * u64::from(part.units);
                }
            }
            take(&cell);
        }
    }
}

fn add_row(sums: &mut [u32], row: &[u8], bytes_per_sample: usize, units: u32) {
    match (bytes_per_sample, units) {
        (1, 1) => {
            for (sum, &value) in sums.iter_mut().zip(row) {
                *sum += u32::from(value);
            }
        }
        (1, _) => {
            for (sum, &value) in sums.iter_mut().zip(row) {
                *sum += u32::from(value) * units;
            }
        }
        _ => {
            let (values, _) = row.as_chunks::<2>();
            for (sum, &value) in sums.iter_mut().zip(values) {
                *sum += u32::from(u16::from_le_bytes(value)) * units;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use taceva_core::PixelFormat;

    #[test]
    fn five_pixels_over_two_cells_share_the_middle_one() {
        let axis = Axis::new(5, 2);
        assert_eq!((axis.cell, axis.pixel), (5, 2));
        let middle = PartialPixel { pixel: 2, units: 1 };
        assert_eq!(
            axis.spans,
            [
                Span {
                    whole: 0..2,
                    before: None,
                    after: Some(middle)
                },
                Span {
                    whole: 3..5,
                    before: Some(middle),
                    after: None
                },
            ]
        );
    }

    #[test]
    fn every_cell_of_every_ratio_is_fully_covered() {
        for source in 1..40 {
            for target in 1..=source {
                let axis = Axis::new(source, target);
                for span in &axis.spans {
                    let units: u32 = [span.before, span.after]
                        .iter()
                        .flatten()
                        .map(|part| part.units)
                        .sum();
                    let whole = u32::try_from(span.whole.len()).expect("small");
                    assert_eq!(
                        whole * axis.pixel + units,
                        axis.cell,
                        "{source} to {target}"
                    );
                }
            }
        }
    }

    #[test]
    fn the_largest_allowed_column_of_full_pixels_does_not_overflow() {
        let info = FrameInfo {
            width: 1,
            height: AreaSums::ROWS_MAX,
            format: PixelFormat::Gray16,
        };
        let bytes = vec![0xff; info.byte_len().expect("small")];
        let frame = Frame::new(info, bytes).expect("whole");
        for height in [1, 2, AreaSums::ROWS_MAX - 1] {
            let sums = AreaSums::new(info, 1, height);
            sums.for_each(&frame, |cell| assert_eq!(cell, [sums.full_scale()]));
        }
    }
}
