//! The kinds of features there are, and sets of them.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::spec::Color;

/// What is taken of every cell of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FeatureKind {
    /// How bright it is: the area average of its pixels. Every change enters, of light as much as of touch.
    Pixels,
    /// How far the markers around it have moved since nobody touched the gel, and how many of them are not seen.
    /// Blind to everything between markers, and to light.
    Markers,
    /// How the surface leans, by the colours of three lamps. Blind to shear and to what leans nowhere, such as the middle of a flat touch.
    Gradients,
    /// Mean, spread and quantiles of its pixels. Blind to where in the cell they lie.
    Statistics,
    /// The numbers of a taxel, of a sensor without pictures: a cell a place. They stand alone, and are of all places.
    Signals,
}

impl FeatureKind {
    /// Every kind, in the order in which the numbers of a cell stand.
    pub const ALL: [FeatureKind; 5] = [
        FeatureKind::Pixels,
        FeatureKind::Markers,
        FeatureKind::Gradients,
        FeatureKind::Statistics,
        FeatureKind::Signals,
    ];

    /// How it is written in settings.
    pub const fn name(self) -> &'static str {
        match self {
            FeatureKind::Pixels => "pixels",
            FeatureKind::Markers => "markers",
            FeatureKind::Gradients => "gradients",
            FeatureKind::Statistics => "statistics",
            FeatureKind::Signals => "signals",
        }
    }

    /// Numbers a cell; 0 of signals, of which the recording decides.
    pub const fn depth(self, color: Color) -> usize {
        match self {
            FeatureKind::Signals => 0,
            FeatureKind::Pixels => color.depth(),
            FeatureKind::Markers | FeatureKind::Gradients => 3,
            FeatureKind::Statistics => 7 * color.depth(),
        }
    }

    /// Whether it compares each frame with the untouched one whatever else is asked for.
    pub const fn needs_reference(self) -> bool {
        matches!(self, FeatureKind::Markers | FeatureKind::Gradients)
    }

    /// Columns and rows where nobody asks for others, in features that begin with this kind.
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

/// One kind or several, each once; written `markers` or `pixels+markers`.
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
    /// Pixels alone.
    pub const PIXELS: FeatureKinds = FeatureKinds(FeatureKind::Pixels.bit());

    /// Signals alone, as they always are.
    pub const SIGNALS: FeatureKinds = FeatureKinds(FeatureKind::Signals.bit());

    /// The kinds that `text` names, joined by `+`; `None` if one does not exist or is named twice, or signals are not alone.
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

    /// The kinds, in the order of [`FeatureKind::ALL`].
    pub fn iter(self) -> impl Iterator<Item = FeatureKind> {
        FeatureKind::ALL
            .into_iter()
            .filter(move |kind| self.contains(*kind))
    }

    /// Whether `kind` is among them.
    pub const fn contains(self, kind: FeatureKind) -> bool {
        self.0 & kind.bit() != 0
    }

    /// Whether they are pixels and nothing else, as in every model of before there were others.
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
