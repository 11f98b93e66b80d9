//! Sides of the picture at which the LEDs of a sensor stand.

use std::fmt;

use serde::{Deserialize, Serialize};

/// Sides of the picture at which the LEDs of each colour stand; `None` for an unknown side.
/// This struct gets no further field, because a picture has no further colour.
///
/// ```
/// use taceva_dataset::{Leds, PictureSide};
///
/// let leds = Leds {
///     green: Some(PictureSide::Top),
///     ..Leds::default()
/// };
/// assert_eq!(leds.sides(), [None, Some(PictureSide::Top), None]);
/// assert!(Leds::default().is_unknown());
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, expecting = "a table such as { red = \"left\" }")]
pub struct Leds {
    /// Side of the red LEDs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub red: Option<PictureSide>,
    /// Side of the green LEDs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub green: Option<PictureSide>,
    /// Side of the blue LEDs.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub blue: Option<PictureSide>,
}

/// Side of a picture. This enum gets no further variant.
///
/// ```
/// use taceva_dataset::PictureSide;
///
/// assert!(PictureSide::Left < PictureSide::Bottom);
/// assert_eq!(PictureSide::Top.to_string(), "top");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum PictureSide {
    /// Left edge: the first pixel column.
    Left,
    /// Right edge: the last pixel column.
    Right,
    /// Upper edge: the first pixel row.
    Top,
    /// Lower edge: the last pixel row.
    Bottom,
}

impl fmt::Display for PictureSide {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            PictureSide::Left => "left",
            PictureSide::Right => "right",
            PictureSide::Top => "top",
            PictureSide::Bottom => "bottom",
        })
    }
}

impl Leds {
    /// Sides of red, green and blue.
    pub fn sides(self) -> [Option<PictureSide>; 3] {
        [self.red, self.green, self.blue]
    }

    /// True if no side is known.
    pub fn is_unknown(&self) -> bool {
        *self == Leds::default()
    }
}
