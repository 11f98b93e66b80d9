//! Direction of a press at the time of a sample.

use crate::display::display;

/// Direction of a press: loading or unloading. This enum gets no further variant: an indenter moves in, moves out or rests, and a sample at rest has
/// no phase.
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
    /// Name of the phase in tables.
    pub const fn name(self) -> &'static str {
        match self {
            Phase::Load => "load",
            Phase::Unload => "unload",
        }
    }

    /// Returns the phase called `name`; `None` if no phase has this name.
    pub fn from_name(name: &str) -> Option<Phase> {
        [Phase::Load, Phase::Unload]
            .into_iter()
            .find(|phase| phase.name() == name)
    }
}

display!(Phase, name);
