//! Branch of a press on which a sample was taken.

use crate::display::display;

/// Branch of a press. This enum gets no further variant: an indenter moves in, moves out, or rests, and samples at rest have no branch.
///
/// ```
/// use taceva_core::Phase;
/// assert_eq!((Phase::from_name("load"), Phase::Unload.name()), (Some(Phase::Load), "unload"));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum Phase {
    /// The indenter moves into the gel.
    Load,
    /// The indenter moves out of the gel.
    Unload,
}

impl Phase {
    /// Name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Phase::Load => "load",
            Phase::Unload => "unload",
        }
    }

    /// Phase with the name `name`; `None` for another text.
    pub fn from_name(name: &str) -> Option<Phase> {
        [Phase::Load, Phase::Unload]
            .into_iter()
            .find(|phase| phase.name() == name)
    }
}

display!(Phase, name);
