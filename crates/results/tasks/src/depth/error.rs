//! Errors of depth maps and of their definitions.

/// Reason why a depth map, a pair of depth maps or a definition is refused.
///
/// ```
/// use taceva_tasks::depth::DepthMap;
/// let refused = DepthMap::new(2, 2, vec![0.0; 3]).map_err(|error| error.to_string());
/// assert_eq!(refused, Err("the map has 3 pixels, expected 2 x 2 = 4".to_owned()));
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum DepthError {
    /// A map with another number of pixels than its size states.
    #[error("the map has {have} pixels, expected {rows} x {columns} = {}", rows.saturating_mul(*columns))]
    Pixels {
        /// Number of pixels found.
        have: usize,
        /// Number of rows of pixels.
        rows: usize,
        /// Number of columns of pixels.
        columns: usize,
    },
    /// A map without a pixel.
    #[error("the map has {rows} x {columns} pixels, expected at least one pixel")]
    NoPixel {
        /// Number of rows of pixels.
        rows: usize,
        /// Number of columns of pixels.
        columns: usize,
    },
    /// A depth that is infinite, or too great.
    #[error(
        "pixel {column}, {row} of the map is {value}, expected a depth from -1e9 to 1e9 mm, or NaN for an invalid pixel"
    )]
    Depth {
        /// Row of the pixel, from 0.
        row: usize,
        /// Column of the pixel, from 0.
        column: usize,
        /// Depth found, mm.
        value: f64,
    },
    /// A missing or unknown unit.
    #[error("the unit of the depth map is `{found}`, expected `mm`, `um` or `m`; state `unit`")]
    Unit {
        /// Text found; empty for a missing unit.
        found: String,
    },
    /// Two maps of different size.
    #[error("row {row}: the {which} has {have} pixels, expected {expected} as {of}")]
    OtherSize {
        /// Row of the sample.
        row: u64,
        /// Name of the map: `prediction`, `truth`.
        which: &'static str,
        /// Size found: `3 x 4`.
        have: String,
        /// Size expected.
        expected: String,
        /// Name of the map with the expected size.
        of: &'static str,
    },
    /// A contact threshold that is not a valid depth, mm.
    #[error("the gate is {0} mm, expected a number from 0 to 1e9 mm")]
    Gate(f64),
    /// A pixel size that is not above 0, or too great, mm.
    #[error("the size of a pixel is {0} mm, expected a number from 1e-9 to 1e9 mm")]
    PixelSize(f64),
}
