//! Kinds of features that are computed from each cell of a frame, and sets of kinds.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::spec::Color;

/// Kind of features that are computed for each cell of the grid over a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FeatureKind {
    /// Brightness, averaged over the area of the cell. Changes of light affect it as touches do.
    Pixels,
    /// Displacement of the gel from its untouched state, measured at nearby markers, and the share of markers that are not visible. Changes of light
    /// have little effect. Details between the markers are not seen.
    Markers,
    /// Slopes of the surface, computed from the colours of three lamps. Shear, and the middle of a flat touch, are not seen.
    Gradients,
    /// Mean, standard deviation and quantiles of the pixels in the cell. The positions of the pixels within the cell do not matter.
    Statistics,
    /// Readings of taxels, for sensors without pictures. Each taxel is a cell. This kind cannot be combined with other kinds.
    Signals,
}

impl FeatureKind {
    /// All kinds. The values of a cell have the same order.
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

    /// Number of values per cell. 0 for signals, whose number of values depends on the recording.
    pub const fn depth(self, color: Color) -> usize {
        match self {
            FeatureKind::Signals => 0,
            FeatureKind::Pixels => color.depth(),
            FeatureKind::Markers | FeatureKind::Gradients => 3,
            FeatureKind::Statistics => 7 * color.depth(),
        }
    }

    /// True if this kind needs a reference frame of the untouched gel.
    pub const fn needs_reference(self) -> bool {
        matches!(self, FeatureKind::Markers | FeatureKind::Gradients)
    }

    /// Default number of columns and of rows of the grid, if this is the first requested kind.
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

/// Set of kinds of features. In settings it is written as `markers` or `pixels+markers`.
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
    /// Set that contains only [`FeatureKind::Pixels`].
    pub const PIXELS: FeatureKinds = FeatureKinds(FeatureKind::Pixels.bit());

    /// Set that contains only [`FeatureKind::Signals`]. Other kinds cannot be added.
    pub const SIGNALS: FeatureKinds = FeatureKinds(FeatureKind::Signals.bit());

    /// Parses names of kinds joined by `+`. `None` if a kind is unknown or repeated, or if signals are combined with other kinds.
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

    /// Iterates over the kinds of the set in the order of [`FeatureKind::ALL`].
    pub fn iter(self) -> impl Iterator<Item = FeatureKind> {
        FeatureKind::ALL
            .into_iter()
            .filter(move |kind| self.contains(*kind))
    }

    /// True if the set contains `kind`.
    pub const fn contains(self, kind: FeatureKind) -> bool {
        self.0 & kind.bit() != 0
    }

    /// True if the set contains only pixels. Such sets are not written to model files.
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
            .ok_or_else(|| format!("`{}` names no kinds of features, expected pixels, markers, gradients or statistics, or several joined by +", taceva_core::shown(&text)))
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
