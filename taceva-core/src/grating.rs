//! Gratings for tests of spatial resolution.

use crate::display::display;

/// Relief of a grating, with one period in each direction of repetition. This enum gets no further variant in a compatible version: the metrics of
/// spatial resolution are defined for these two kinds.
///
/// ```
/// use taceva_core::GratingKind;
/// assert_eq!(GratingKind::from_name("dot"), Some(GratingKind::Dot));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum GratingKind {
    /// Parallel ridges.
    Line,
    /// A square lattice of bumps.
    Dot,
}

impl GratingKind {
    /// Both kinds.
    pub const ALL: [GratingKind; 2] = [GratingKind::Line, GratingKind::Dot];

    /// Name in tables.
    pub const fn name(self) -> &'static str {
        match self {
            GratingKind::Line => "line",
            GratingKind::Dot => "dot",
        }
    }

    /// Kind with the name `name`; `None` for another text.
    pub fn from_name(name: &str) -> Option<GratingKind> {
        GratingKind::ALL
            .into_iter()
            .find(|kind| kind.name() == name)
    }
}

display!(GratingKind, name);
