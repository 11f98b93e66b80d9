//! Gratings of boards for spatial resolution.

use std::fmt;

/// The relief of a grating; both have one period in each direction they repeat in. It gets no further variant in a compatible version: spatial
/// resolution is defined for these two, and another relief is another metric.
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
    /// A square grid of bumps.
    Dot,
}

impl GratingKind {
    /// Both kinds.
    pub const ALL: [GratingKind; 2] = [GratingKind::Line, GratingKind::Dot];

    /// The word used in tables.
    pub const fn name(self) -> &'static str {
        match self {
            GratingKind::Line => "line",
            GratingKind::Dot => "dot",
        }
    }

    /// The kind written as `name`.
    pub fn from_name(name: &str) -> Option<GratingKind> {
        GratingKind::ALL
            .into_iter()
            .find(|kind| kind.name() == name)
    }
}

impl fmt::Display for GratingKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
