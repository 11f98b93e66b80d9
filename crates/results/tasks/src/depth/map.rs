//! Depth maps with invalid pixels.

use serde::{Deserialize, Serialize};

use super::error::DepthError;
use crate::vector::GREATEST_MM;

/// Depths in mm by row and column of pixels; NaN marks an invalid pixel.
///
/// ```
/// use taceva_tasks::depth::DepthMap;
/// let map = DepthMap::in_unit(1, 2, vec![250.0, f64::NAN], "um")?;
/// assert_eq!((map.size(), map.mm()[0]), ([1, 2], 0.25));
/// # Ok::<(), taceva_tasks::depth::DepthError>(())
/// ```
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(into = "Stored", try_from = "Stored")]
pub struct DepthMap {
    rows: usize,
    columns: usize,
    mm: Vec<f64>,
}

/// Serialized map; invalid pixels are missing numbers.
#[derive(Serialize, Deserialize)]
struct Stored {
    rows: usize,
    columns: usize,
    mm: Vec<Option<f64>>,
}

impl From<DepthMap> for Stored {
    fn from(map: DepthMap) -> Stored {
        let valid = |depth: f64| (!depth.is_nan()).then_some(depth);
        Stored {
            rows: map.rows,
            columns: map.columns,
            mm: map.mm.into_iter().map(valid).collect(),
        }
    }
}

impl TryFrom<Stored> for DepthMap {
    type Error = DepthError;
    fn try_from(stored: Stored) -> Result<DepthMap, DepthError> {
        let mm = stored.mm.into_iter().map(|depth| depth.unwrap_or(f64::NAN));
        DepthMap::new(stored.rows, stored.columns, mm.collect())
    }
}

impl DepthMap {
    /// Map of `rows` × `columns` depths in mm, row by row. Negative depths are kept.
    ///
    /// # Errors
    /// [`DepthError::NoPixel`], [`DepthError::Pixels`] for another number of depths, [`DepthError::Depth`] for an infinite or too great
    /// depth.
    pub fn new(rows: usize, columns: usize, mm: Vec<f64>) -> Result<DepthMap, DepthError> {
        if rows == 0 || columns == 0 {
            return Err(DepthError::NoPixel { rows, columns });
        }
        if rows.checked_mul(columns) != Some(mm.len()) {
            let have = mm.len();
            return Err(DepthError::Pixels {
                have,
                rows,
                columns,
            });
        }
        match mm.iter().position(|depth| depth.abs() > GREATEST_MM) {
            Some(at) => Err(DepthError::Depth {
                row: at / columns,
                column: at % columns,
                value: mm[at],
            }),
            None => Ok(DepthMap { rows, columns, mm }),
        }
    }

    /// Map of depths in the unit `mm`, `um` (`µm`) or `m`.
    ///
    /// # Errors
    /// [`DepthError::Unit`] for another or an empty text; otherwise errors of [`new`](DepthMap::new).
    pub fn in_unit(
        rows: usize,
        columns: usize,
        values: Vec<f64>,
        unit: &str,
    ) -> Result<DepthMap, DepthError> {
        let to_mm: fn(f64) -> f64 = match unit {
            "mm" => |mm| mm,
            "um" | "µm" => |um| um / 1000.0,
            "m" => |m| m * 1000.0,
            found => {
                let found = found.to_owned();
                return Err(DepthError::Unit { found });
            }
        };
        let mm = values.into_iter().map(to_mm);
        DepthMap::new(rows, columns, mm.collect())
    }

    /// Number of rows and of columns of pixels.
    #[must_use]
    pub fn size(&self) -> [usize; 2] {
        [self.rows, self.columns]
    }

    /// Depths in mm, row by row; NaN for invalid pixels.
    #[must_use]
    pub fn mm(&self) -> &[f64] {
        &self.mm
    }

    /// Depth of a pixel of the map, mm.
    pub(super) fn at(&self, row: usize, column: usize) -> f64 {
        self.mm[row * self.columns + column]
    }

    /// The map with only the pixels that are also valid in `other`, a map of the same size.
    pub(super) fn where_valid(&self, other: &DepthMap) -> DepthMap {
        let pixels = self.mm.iter().zip(&other.mm);
        let mm = pixels.map(|(&depth, other)| match other.is_nan() {
            true => f64::NAN,
            false => depth,
        });
        DepthMap {
            mm: mm.collect(),
            ..*self
        }
    }

    /// Size for messages: `240 x 320`.
    pub(super) fn size_text(&self) -> String {
        format!("{} x {}", self.rows, self.columns)
    }
}

/// Equality of sizes and depths. Two invalid pixels are equal.
impl PartialEq for DepthMap {
    fn eq(&self, other: &DepthMap) -> bool {
        let bits = |depth: &f64| (!depth.is_nan()).then_some((depth + 0.0).to_bits());
        let same = self.mm.iter().map(bits).eq(other.mm.iter().map(bits));
        self.size() == other.size() && same
    }
}
