//! Depth maps of a task: the meaning of their numbers, and the place of each map.

use std::fmt;

use serde::{Deserialize, Serialize};
use taceva_core::{SourceUnit, Unit};

use crate::digest::Digest;
use crate::pack::Span;

/// Meaning of the numbers of depth maps: a depth is a number times `scale` in the unit `unit`.
///
/// ```
/// use taceva_dataset::MapFacts;
///
/// let mut facts = MapFacts::new("um");
/// facts.scale = 0.5;
/// assert_eq!(facts.mm(3000.0)?, 1.5);
/// assert!(MapFacts::new("N").mm(1.0).is_err());
/// # Ok::<(), String>(())
/// ```
#[non_exhaustive]
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct MapFacts {
    /// Unit of the depths, such as `mm` or `um`.
    pub unit: String,
    /// Factor from stored numbers to depths in `unit`.
    pub scale: f64,
    /// Distances of neighbouring columns and of neighbouring rows of pixels, mm; `None` if unknown.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pixel_mm: Option<[f64; 2]>,
    /// Number that marks an invalid pixel, besides NaN; `None` if only NaN does.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub invalid: Option<f64>,
}

/// An import accepts only finite numbers in these fields, so each value equals itself.
impl Eq for MapFacts {}

impl MapFacts {
    /// Maps whose numbers are depths in `unit`.
    pub fn new(unit: impl Into<String>) -> MapFacts {
        MapFacts {
            unit: unit.into(),
            scale: 1.0,
            pixel_mm: None,
            invalid: None,
        }
    }

    /// Depth of the number `number`, mm.
    ///
    /// # Errors
    /// Error message if the unit is not a length, or if the scale is not a finite number.
    pub fn mm(&self, number: f64) -> Result<f64, String> {
        Ok(self.length()?.convert(number * self.scale))
    }

    /// Unit of the depths, which must be a length.
    pub(crate) fn length(&self) -> Result<SourceUnit, String> {
        let unit = SourceUnit::parse(&self.unit).map_err(|error| error.to_string())?;
        if unit.unit() != Unit::Millimetre {
            return Err(format!(
                "`{}` is not a unit of length, such as \"mm\" or \"um\"",
                self.unit
            ));
        }
        match self.scale.is_finite() {
            true => Ok(unit),
            false => Err(format!("the scale is {}, expected a number", self.scale)),
        }
    }
}

/// Place of a depth map in the pack of its task, and the digest of its bytes.
///
/// ```
/// use taceva_dataset::{Digest, MapEntry};
///
/// let entry = MapEntry::new(5, 7, Digest::of(b"map"));
/// assert_eq!(entry.to_string(), "@5+7");
/// ```
#[derive(Clone, Copy, Debug)]
pub struct MapEntry {
    pub(crate) span: Span,
    pub(crate) digest: Digest,
}

impl MapEntry {
    /// Map of `length` bytes at `offset` with the digest `digest`.
    pub fn new(offset: u64, length: u32, digest: Digest) -> MapEntry {
        MapEntry {
            span: Span {
                offset,
                length,
                is_difference: false,
            },
            digest,
        }
    }

    /// Digest of the bytes of the map.
    pub fn digest(&self) -> Digest {
        self.digest
    }
}

/// Equality of content: two places can have the same map.
impl PartialEq for MapEntry {
    fn eq(&self, other: &MapEntry) -> bool {
        self.digest == other.digest
    }
}

impl fmt::Display for MapEntry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.span.fmt(f)
    }
}
