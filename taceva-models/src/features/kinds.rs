//! Kinds of features, and sets of them.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::spec::Color;

/// Kind of features computed for each cell.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FeatureKind {
    /// Brightness: the area average of pixels. Lighting and touch affect it equally.
    Pixels,
    /// Displacement of nearby markers from the untouched gel, and the share of unseen markers. Insensitive to lighting, and to details between markers.
    Markers,
    /// Surface slopes, computed from the colours of three lamps. Insensitive to shear and to flat areas, such as the middle of a flat touch.
    Gradients,
    /// Mean, standard deviation and quantiles of pixels, regardless of pixel positions in the cell.
    Statistics,
    /// Values of taxels, for sensors without pictures. There is one cell per taxel, and no combination with other kinds.
    Signals,
}

impl FeatureKind {
    /// All kinds, in the order of their values in a cell.
    pub const ALL: [FeatureKind; 5] = [
        FeatureKind::Pixels,
        FeatureKind::Markers,
        FeatureKind::Gradients,
        FeatureKind::Statistics,
        FeatureKind::Signals,
    ];

    /// Name of the kind in settings.
    pub const fn name(self) -> &'static str {
        match self {
            FeatureKind::Pixels => "pixels",
            FeatureKind::Markers => "markers",
            FeatureKind::Gradients => "gradients",
            FeatureKind::Statistics => "statistics",
            FeatureKind::Signals => "signals",
        }
    }

    /// Number of values per cell; 0 for signals, because their number depends on the recording.
    pub const fn depth(self, color: Color) -> usize {
        match self {
            FeatureKind::Signals => 0,
            FeatureKind::Pixels => color.depth(),
            FeatureKind::Markers | FeatureKind::Gradients => 3,
            FeatureKind::Statistics => 7 * color.depth(),
        }
    }

    /// True if this kind always compares a frame with the untouched frame.
    pub const fn needs_reference(self) -> bool {
        matches!(self, FeatureKind::Markers | FeatureKind::Gradients)
    }

    /// Default number of columns and rows for features whose first kind is this kind.
    pub(super) const fn side(self) -> u32 {
        match self {
            FeatureKind::Pixels | FeatureKind::Gradients | FeatureKind::Signals => 32,
            FeatureKind::Markers => 16,
            FeatureKind::Statistics => 8,
        }
    }

    const fn bit(self) -> u8 {
        1 << self as u8
    }
}

/// Set of kinds of features, written `markers` or `pixels+markers`.
///
/// ```
/// use taceva_models::{FeatureKind, FeatureKinds};
/// let kinds = FeatureKinds::parse("statistics+markers").expect("both exist");
/// assert!(kinds.contains(FeatureKind::Markers));
/// assert_eq!(kinds.to_string(), "markers+statistics");
/// assert!(FeatureKinds::parse("markers+smells").is_none());
/// ```
#[derive(Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub struct FeatureKinds(u8);

impl FeatureKinds {
    /// Set of pixels only.
    pub const PIXELS: FeatureKinds = FeatureKinds(FeatureKind::Pixels.bit());

    /// Set of signals, which cannot be combined with other kinds.
    pub const SIGNALS: FeatureKinds = FeatureKinds(FeatureKind::Signals.bit());

    /// Parses kinds joined by `+`; `None` if a kind is unknown or repeated, or if signals are combined.
    pub fn parse(text: &str) -> Option<FeatureKinds> {
        let mut kinds = FeatureKinds(0);
        for word in text.split('+') {
            let kind = FeatureKind::ALL
                .into_iter()
                .find(|kind| kind.name() == word)?;
            if kinds.contains(kind) {
                return None;
            }
            kinds.0 |= kind.bit();
        }
        let is_mixed = kinds.contains(FeatureKind::Signals) && kinds != FeatureKinds::SIGNALS;
        (!is_mixed).then_some(kinds)
    }

    /// Kinds of the set, in the order of [`FeatureKind::ALL`].
    pub fn iter(self) -> impl Iterator<Item = FeatureKind> {
        FeatureKind::ALL
            .into_iter()
            .filter(move |kind| self.contains(*kind))
    }

    /// True if the set contains `kind`.
    pub const fn contains(self, kind: FeatureKind) -> bool {
        self.0 & kind.bit() != 0
    }

    /// True if the set contains only pixels, the default of older model files.
    pub fn are_pixels(&self) -> bool {
        *self == FeatureKinds::PIXELS
    }
}

impl Default for FeatureKinds {
    fn default() -> FeatureKinds {
        FeatureKinds::PIXELS
    }
}

impl From<FeatureKind> for FeatureKinds {
    fn from(kind: FeatureKind) -> FeatureKinds {
        FeatureKinds(kind.bit())
    }
}

impl fmt::Display for FeatureKinds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (position, kind) in self.iter().enumerate() {
            let joint = if position == 0 { "" } else { "+" };
            write!(f, "{joint}{}", kind.name())?;
        }
        Ok(())
    }
}

impl fmt::Debug for FeatureKinds {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

impl From<FeatureKinds> for String {
    fn from(kinds: FeatureKinds) -> String {
        kinds.to_string()
    }
}

impl TryFrom<String> for FeatureKinds {
    type Error = String;

    fn try_from(text: String) -> Result<FeatureKinds, String> {
        FeatureKinds::parse(&text)
            .ok_or_else(|| format!("`{}` names no kinds of features", taceva_core::shown(&text)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_set_of_kinds_is_read_as_it_is_written() {
        for bits in 1..=16 {
            let kinds = FeatureKinds(bits);
            assert_eq!(FeatureKinds::parse(&kinds.to_string()), Some(kinds));
        }
    }

    #[test]
    fn no_kind_and_one_named_twice_are_refused() {
        for text in [
            "",
            "pixels+",
            "pixels+pixels",
            "Pixels",
            "pixels,markers",
            "pixels+signals",
        ] {
            assert_eq!(FeatureKinds::parse(text), None, "{text}");
        }
    }
}
