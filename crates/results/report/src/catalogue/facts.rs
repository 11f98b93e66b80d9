//! Facts about a sensor other than scores: limits and outer dimensions.

use serde::Deserialize;

/// Limits of a sensor.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Limits {
    /// Id of the source.
    pub source: String,
    /// Greatest indentation, in mm.
    #[serde(rename = "Pz_max_mm")]
    pub pz_max_mm: f64,
    /// Greatest normal force, in N.
    #[serde(rename = "Fz_max_N")]
    pub fz_max_n: f64,
    /// Greatest distance of a contact from the centre of the sensing surface, in mm.
    pub radius_max_mm: f64,
}

impl Limits {
    /// Channel, value, unit and definition of each limit.
    pub(super) fn rows(&self) -> [(&'static str, f64, &'static str, &'static str); 3] {
        [
            (
                "Pz",
                self.pz_max_mm,
                "mm",
                "greatest indentation that was tested",
            ),
            (
                "Fz",
                self.fz_max_n,
                "N",
                "greatest normal force that was tested",
            ),
            (
                "radius",
                self.radius_max_mm,
                "mm",
                "greatest distance of a tested contact from the centre",
            ),
        ]
    }
}

/// Test conditions of the limits.
pub(super) const TESTED: &str = "presses of the study; the sensor may withstand more";
/// Definition of outer dimensions.
pub(super) const SIZE: &str = "outer dimensions in the order of the source";

/// Outer dimensions of a sensor.
///
/// ```
/// let digit = taceva_report::catalogue::find("DIGIT").expect("there");
/// assert_eq!(digit.size.map(|size| size.shown()).as_deref(), Some("20 × 27 × 18"));
/// ```
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Size {
    /// Dimensions in mm: width, depth and height in the order of the source, a diameter and a length, or only a diameter.
    pub mm: Vec<f64>,
    /// Id of the source.
    pub source: String,
    /// Place in the source: `table`, `figure` or `text`.
    pub read_from: String,
    /// Measured part: `housing`, `fingertip`.
    pub conditions: String,
}

impl Size {
    /// Dimensions in mm: `20 × 27 × 18`.
    pub fn shown(&self) -> String {
        let sides = self.mm.iter().map(f64::to_string);
        sides.collect::<Vec<_>>().join(" × ")
    }

    /// Greatest dimension in mm; `None` if only a diameter is known.
    ///
    /// ```
    /// let digit = taceva_report::catalogue::find("DIGIT").and_then(|digit| digit.size).expect("there");
    /// assert_eq!((digit.greatest_mm(), digit.middle_mm()), (Some(27.0), Some(20.0)));
    /// ```
    pub fn greatest_mm(&self) -> Option<f64> {
        let sides = self.mm.iter().copied();
        (self.mm.len() > 1).then(|| sides.fold(0.0, f64::max))
    }

    /// Median of the three outer dimensions, in mm; a diameter counts as two dimensions. A square opening with this side admits the sensor
    /// lengthwise.
    pub fn middle_mm(&self) -> Option<f64> {
        match self.mm[..] {
            [a, b, c] => Some(a.min(b).max(a.max(b).min(c))),
            [diameter, ..] => Some(diameter),
            [] => None,
        }
    }

    /// True for one to three positive dimensions.
    pub(super) fn is_possible(&self) -> bool {
        let is_length = |side: &f64| side.is_finite() && *side > 0.0;
        (1..=3).contains(&self.mm.len()) && self.mm.iter().all(is_length)
    }
}
