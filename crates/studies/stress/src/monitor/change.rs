//! Changes of pictures that a monitor finds, with their remedies.

use std::fmt;

use super::limit::WINDOW;

/// Kind of a change of the pictures of a sensor.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
#[non_exhaustive]
pub enum Change {
    /// Untouched pictures differed from the reference before the monitor began.
    Reference,
    /// Untouched pictures are brighter or darker. Typical causes: light, exposure.
    Brightness,
    /// Large parts of untouched pictures have changed. Typical causes: a lamp, a moved camera, a tear.
    Pattern,
    /// Details of untouched pictures have changed. Typical causes: blur, noise, dead pixels, bad lines, scratches, dust.
    Detail,
    /// Lines of some untouched pictures are displaced or lost. Typical causes: a cable, a connector.
    Lines,
    /// Some untouched pictures are equal to the previous picture.
    Repeats,
    /// Pictures of contact are unlike the training pictures.
    Contact,
}

impl Change {
    /// Name of the change, one word.
    ///
    /// ```
    /// assert_eq!(taceva_stress::Change::Brightness.name(), "brightness");
    /// ```
    pub fn name(self) -> &'static str {
        match self {
            Change::Reference => "reference",
            Change::Brightness => "brightness",
            Change::Pattern => "pattern",
            Change::Detail => "detail",
            Change::Lines => "lines",
            Change::Repeats => "repeats",
            Change::Contact => "contact",
        }
    }

    /// Action that removes the cause of the change.
    pub fn remedy(self) -> &'static str {
        match self {
            Change::Reference => {
                "record a new untouched picture; if readings stay wrong, calibrate again"
            }
            Change::Brightness => {
                "record a new untouched picture, which corrects most changes of light and exposure; if readings stay wrong, look at the lamps and \
                 the settings of the camera, then calibrate again"
            }
            Change::Pattern => {
                "record a new untouched picture, which corrects most changes of light and position; if readings stay wrong, look at lamps, gel and \
                 the mount of the camera, then calibrate again"
            }
            Change::Detail => {
                "look at the camera: focus, dirt on the lens, dead pixels, cable; for scratches and dust on the gel, record a new untouched picture"
            }
            Change::Lines => {
                "look at the cable and the connectors of the camera: lines of its pictures are displaced or lost"
            }
            Change::Repeats => {
                "look at the camera, its cable and its driver: new pictures do not arrive"
            }
            Change::Contact => {
                "compare object, place and force with those of the calibration; if they are the same, calibrate again"
            }
        }
    }
}

/// A change, when it was found, and how strong it is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Alarm {
    /// Kind of the change.
    pub change: Change,
    /// Number of the picture, from 1, among all untouched pictures, or among all pictures of contact.
    pub picture: u64,
    /// Change of the pictures divided by their change by contact. For repeats and contact: the fraction of the newest 30 pictures with the change.
    pub strength: f64,
}

impl Alarm {
    /// Creates the alarm for a change with the strength `strength`; `None` without a strength.
    pub(super) fn of(change: Change, picture: u64, strength: Option<f64>) -> Option<Alarm> {
        let strength = strength?;
        Some(Alarm {
            change,
            picture,
            strength,
        })
    }
}

impl fmt::Display for Alarm {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let stimulus = format!("by {:.2} of the change by contact", self.strength);
        let share = format!("{:.0} % of the newest {WINDOW}", 100.0 * self.strength);
        let words = match self.change {
            Change::Reference => {
                format!(
                    "untouched pictures differed from the reference from the beginning, {stimulus}"
                )
            }
            Change::Brightness => {
                format!("untouched pictures have become brighter or darker, {stimulus}")
            }
            Change::Pattern => {
                format!("untouched pictures have changed in large parts, {stimulus}")
            }
            Change::Detail => format!("untouched pictures have changed in detail, {stimulus}"),
            Change::Lines => {
                format!(
                    "lines of some untouched pictures are far from those of the others, {stimulus}"
                )
            }
            Change::Repeats => format!("{share} untouched pictures repeat the previous picture"),
            Change::Contact => {
                format!("{share} pictures of contact are outside the training pictures")
            }
        };
        let remedy = self.change.remedy();
        write!(f, "{words} (picture {}): {remedy}", self.picture)
    }
}
