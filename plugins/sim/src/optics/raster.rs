//! Pixel grid of a frame over the field of view.

use crate::number::narrow;

/// A pixel grid over a field of view centred on the axis: x to the right, y up, row 0 at the top.
///
/// A frame with another aspect ratio shows the same field with pixels that are not square.
#[derive(Clone, Copy, Debug)]
pub(super) struct Raster {
    pub(super) width: usize,
    pub(super) height: usize,
    /// Width and height of a pixel, in the unit of the field of view.
    pub(super) pitch: [f32; 2],
}

impl Raster {
    /// Grid of `size` pixels over `field`, width first.
    pub(super) fn new(size: [usize; 2], field: [f64; 2]) -> Raster {
        let pitch = |axis: usize| narrow(field[axis] / crate::number::count(size[axis]));
        Raster {
            width: size[0],
            height: size[1],
            pitch: [pitch(0), pitch(1)],
        }
    }

    /// x of the centre of a column.
    #[inline]
    pub(super) fn x(&self, column: usize) -> f32 {
        self.pitch[0] * (whole(column) + 0.5 - 0.5 * whole(self.width))
    }

    /// y of the centre of a row.
    #[inline]
    pub(super) fn y(&self, row: usize) -> f32 {
        self.pitch[1] * (0.5 * whole(self.height) - 0.5 - whole(row))
    }

    /// Columns with centres within `reach` of `x`.
    pub(super) fn columns(&self, x: f32, reach: f32) -> std::ops::Range<usize> {
        let middle = x / self.pitch[0] + 0.5 * whole(self.width) - 0.5;
        span(middle, reach / self.pitch[0], self.width)
    }

    /// Rows with centres within `reach` of `y`.
    pub(super) fn rows(&self, y: f32, reach: f32) -> std::ops::Range<usize> {
        let middle = 0.5 * whole(self.height) - 0.5 - y / self.pitch[1];
        span(middle, reach / self.pitch[1], self.height)
    }
}

fn span(middle: f32, reach: f32, count: usize) -> std::ops::Range<usize> {
    let clamp = |at: f32| -> usize {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "clamped to the frame, and a float cast saturates"
        )]
        let at = at.clamp(0.0, whole(count)) as usize;
        at
    };
    let first = clamp((middle - reach).ceil());
    first..clamp((middle + reach).floor() + 1.0).max(first)
}

fn whole(count: usize) -> f32 {
    count as f32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_middle_of_the_frame_is_the_axis_and_y_goes_up() {
        let raster = Raster::new([4, 2], [8.0, 6.0]);
        let places = [raster.x(0), raster.x(3), raster.y(0), raster.y(1)];
        let expected = [-3.0, 3.0, 1.5, -1.5];
        assert_eq!(places.map(f32::to_bits), expected.map(f32::to_bits));
    }

    #[test]
    fn spans_hold_the_middles_within_reach_and_stay_on_the_frame() {
        let raster = Raster::new([10, 10], [10.0, 10.0]);
        assert_eq!(raster.columns(0.5, 1.0), 4..7);
        assert_eq!(raster.rows(4.5, 1.2), 0..2);
        assert!(raster.columns(40.0, 2.0).is_empty());
        assert!(raster.rows(-40.0, 2.0).is_empty());
        assert_eq!(raster.columns(0.0, 1e9), 0..10);
    }
}
