//! Gratings pressed on the gel to test spatial resolution.

use crate::display::display;

/// Shape of a grating. This enum gets no further variant in a compatible version: the metrics of spatial resolution are defined for these two kinds.
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
    /// Both kinds of grating.
    pub const ALL: [GratingKind; 2] = [GratingKind::Line, GratingKind::Dot];

    /// Name of the kind in tables.
    pub const fn name(self) -> &'static str {
        match self {
            GratingKind::Line => "line",
            GratingKind::Dot => "dot",
        }
    }

    /// Returns the kind called `name`; `None` if no kind has this name.
    pub fn from_name(name: &str) -> Option<GratingKind> {
        GratingKind::ALL
            .into_iter()
            .find(|kind| kind.name() == name)
    }
}

display!(GratingKind, name);
