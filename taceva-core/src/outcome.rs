//! Outcomes of a press on the gel. A press ends early at a limit of depth or force.

use crate::display::display;

/// Limit of depth or force at which a press ends, to protect the gel.
///
/// ```
/// use taceva_core::Limit;
/// assert_eq!((Limit::NormalForce.name(), Limit::from_name("depth")), ("normal-force", Some(Limit::Depth)));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Limit {
    /// Limit of the indentation depth.
    Depth,
    /// Limit of the normal force.
    NormalForce,
    /// Limit of the shear force.
    ShearForce,
}

impl Limit {
    /// Every limit of a press.
    pub const ALL: [Limit; 3] = [Limit::Depth, Limit::NormalForce, Limit::ShearForce];

    /// Name of the limit in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Limit::Depth => "depth",
            Limit::NormalForce => "normal-force",
            Limit::ShearForce => "shear-force",
        }
    }

    /// Returns the limit called `name`; `None` if no limit has this name.
    pub fn from_name(name: &str) -> Option<Limit> {
        Limit::ALL.into_iter().find(|limit| limit.name() == name)
    }
}

display!(Limit, name);

/// Result of a press: completed, ended at a limit, or without contact.
///
/// ```
/// use taceva_core::{Limit, PressOutcome};
/// let ended = PressOutcome::Limited(Limit::NormalForce);
/// assert_eq!(PressOutcome::from_name("normal-force-limit"), Some(ended));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(into = "&'static str", try_from = "String"))]
#[non_exhaustive]
pub enum PressOutcome {
    /// The tip of the robot's tool visited every planned waypoint.
    Complete,
    /// A limit ended the approach. The next waypoint is sampled where the tip rests, within the limits, and deeper waypoints are skipped. The retreat
    /// visits its waypoints. No sample is taken if the limit was reached during the search for the gel.
    Limited(Limit),
    /// The search for the gel ended without contact.
    NoContact,
}

impl PressOutcome {
    /// True if a limit of the gel ended the press.
    pub const fn is_limited(self) -> bool {
        matches!(self, PressOutcome::Limited(_))
    }

    /// Every outcome of a press.
    pub const ALL: [PressOutcome; 5] = [
        PressOutcome::Complete,
        PressOutcome::Limited(Limit::Depth),
        PressOutcome::Limited(Limit::NormalForce),
        PressOutcome::Limited(Limit::ShearForce),
        PressOutcome::NoContact,
    ];

    /// Name of the outcome in files.
    pub const fn name(self) -> &'static str {
        match self {
            PressOutcome::Complete => "complete",
            PressOutcome::Limited(Limit::Depth) => "depth-limit",
            PressOutcome::Limited(Limit::NormalForce) => "normal-force-limit",
            PressOutcome::Limited(Limit::ShearForce) => "shear-force-limit",
            PressOutcome::NoContact => "no-contact",
        }
    }

    /// Returns the outcome called `name`; `None` if no outcome has this name.
    pub fn from_name(name: &str) -> Option<PressOutcome> {
        let mut outcomes = PressOutcome::ALL.into_iter();
        outcomes.find(|outcome| outcome.name() == name)
    }
}

display!(PressOutcome, name);

impl From<PressOutcome> for &'static str {
    fn from(outcome: PressOutcome) -> &'static str {
        outcome.name()
    }
}

impl TryFrom<String> for PressOutcome {
    type Error = String;

    fn try_from(name: String) -> Result<PressOutcome, String> {
        let names = || PressOutcome::ALL.map(PressOutcome::name).join(", ");
        PressOutcome::from_name(&name).ok_or_else(|| {
            format!(
                "`{}` is not an outcome of a press, expected one of {}",
                crate::shown(&name),
                names()
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_outcome_and_every_limit_is_found_by_its_own_name_alone() {
        for outcome in PressOutcome::ALL {
            assert_eq!(PressOutcome::from_name(outcome.name()), Some(outcome));
        }
        for limit in Limit::ALL {
            assert_eq!(Limit::from_name(limit.name()), Some(limit));
            assert!(PressOutcome::ALL.contains(&PressOutcome::Limited(limit)));
        }
        let error = PressOutcome::try_from("stopped".to_owned()).expect_err("no such word");
        assert!(error.contains("`stopped`") && error.contains("no-contact"));
    }
}
