//! Sources with their numbers: estimate, shape, standard uncertainty and degrees of freedom.

use super::evidence::Figure;
use super::freedom::Freedom;
use super::shape::Shape;

/// Input of the model: a source with its estimate and uncertainty as numbers.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Input {
    pub(super) name: String,
    /// Line of the source's table.
    pub(super) line: usize,
    /// True for type A: evaluated by statistics of rows.
    pub(super) is_statistical: bool,
    pub(super) shape: Shape,
    pub(super) value: f64,
    pub(super) u: f64,
    pub(super) freedom: Freedom,
    pub(super) enters: Enters,
    pub(super) from: Option<String>,
    /// Name of the set of inputs that were read together, row by row.
    pub(super) set: Option<String>,
    pub(super) rows: Vec<f64>,
    pub(super) covers: Option<String>,
    /// Measured figure that the source uses.
    pub(super) figure: Option<Figure>,
}

impl Input {
    /// Number of rows of the source, or of its figure; `None` if unknown.
    pub(super) fn n(&self) -> Option<u64> {
        let rows = (!self.rows.is_empty()).then_some(self.rows.len() as u64);
        rows.or(self.figure.as_ref().and_then(|figure| figure.n))
    }

    /// Caveat of the figure, after the name of the source; `None` without a caveat.
    pub(super) fn note(&self) -> Option<String> {
        let note = self.figure.as_ref()?.note.as_ref()?;
        Some(format!("{}: {note}", self.name))
    }
}

/// Term of a source with the estimate δ in the default model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Enters {
    /// The model adds δ.
    Absolute,
    /// The model multiplies by 1 + δ.
    Relative,
    /// The model multiplies by cos δ.
    Cosine,
}

impl Enters {
    pub(super) const NAMES: [(&'static str, Enters); 3] = [
        ("absolute", Enters::Absolute),
        ("relative", Enters::Relative),
        ("cosine", Enters::Cosine),
    ];
}
