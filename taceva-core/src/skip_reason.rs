//! Reasons for skipped work, as typed data instead of log lines.

use std::fmt;

use crate::field::Field;

/// An item that a plan or an evaluation skips, with the reason.
///
/// ```
/// use taceva_core::{SkipReason, Skipped};
/// let skipped = Skipped::new("metric:drift", SkipReason::NotWanted);
/// assert_eq!(skipped.reason, SkipReason::NotWanted);
/// ```
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Skipped {
    /// Name of the skipped item: `metric:repeatability`, `field:frame`, `stage:fit`.
    pub what: String,
    /// Reason for the skip.
    pub reason: SkipReason,
}

impl Skipped {
    /// States that the item `what` is skipped for `reason`.
    pub fn new(what: impl Into<String>, reason: SkipReason) -> Skipped {
        Skipped {
            what: what.into(),
            reason,
        }
    }
}

/// Reason why a plan or an evaluation skips an item.
///
/// ```
/// use taceva_core::{Field, SkipReason};
/// assert_eq!(SkipReason::FieldAbsent(Field::Repeat).to_string(), "no sample carries `repeat`");
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum SkipReason {
    /// No sample has this required field.
    FieldAbsent(Field),
    /// This required channel is not scored.
    ChannelAbsent(String),
    /// The sensor's driver does not declare this required fact.
    FactAbsent(&'static str),
    /// The gel is opaque, so ambient light cannot reach the camera.
    GelIsOpaque,
    /// No requested result reads the item.
    NothingReadsIt,
    /// The samples cannot be divided into training and test parts, for the reason in the text.
    NoSplit(String),
    /// The user did not request the item.
    NotWanted,
    /// The caller supplied the finished result of the item.
    AlreadyThere,
}

impl SkipReason {
    /// One reason of each kind, for tests.
    pub fn all() -> Vec<SkipReason> {
        vec![
            SkipReason::FieldAbsent(Field::Repeat),
            SkipReason::ChannelAbsent("Px".to_owned()),
            SkipReason::FactAbsent("footprint"),
            SkipReason::GelIsOpaque,
            SkipReason::NothingReadsIt,
            SkipReason::NoSplit("2 points are too few".to_owned()),
            SkipReason::NotWanted,
            SkipReason::AlreadyThere,
        ]
    }
}

impl fmt::Display for SkipReason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            SkipReason::FieldAbsent(field) => write!(f, "no sample carries `{field}`"),
            SkipReason::ChannelAbsent(channel) => {
                write!(f, "channel `{}` is not scored", crate::shown(channel))
            }
            SkipReason::FactAbsent(fact) => write!(f, "the sensor's `{fact}` is not declared"),
            SkipReason::GelIsOpaque => {
                f.write_str("the gel is opaque: ambient light cannot reach the camera")
            }
            SkipReason::NothingReadsIt => f.write_str("no requested result reads it"),
            SkipReason::NoSplit(why) => {
                write!(
                    f,
                    "the samples cannot be divided into parts: {}",
                    crate::shown(why)
                )
            }
            SkipReason::NotWanted => f.write_str("not requested"),
            SkipReason::AlreadyThere => f.write_str("a finished result was given"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_reason_has_its_own_line() {
        let lines: Vec<String> = SkipReason::all().iter().map(ToString::to_string).collect();
        assert_eq!(
            lines,
            [
                "no sample carries `repeat`",
                "channel `Px` is not scored",
                "the sensor's `footprint` is not declared",
                "the gel is opaque: ambient light cannot reach the camera",
                "no requested result reads it",
                "the samples cannot be divided into parts: 2 points are too few",
                "not requested",
                "a finished result was given",
            ]
        );
    }
}
