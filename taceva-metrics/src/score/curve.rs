//! A quantity over the levels of another one.

use taceva_core::Unit;

/// Numbers at ascending levels; a level without one is `None`, never a placeholder.
///
/// # Shapes
/// `x`, `values`, `counts`: one length; `band` too, if there is one.
/// # Units
/// Levels in `x_unit`; values in the unit of the [`Variant`](crate::Variant) that holds the curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// The levels.
    pub x: Vec<f64>,
    /// The unit of the levels.
    pub x_unit: Unit,
    /// The value at each level.
    pub values: Vec<Option<f64>>,
    /// How many samples each value is made of.
    pub counts: Vec<u64>,
    /// What lies below and above each value; the metric says of which meaning.
    pub band: Option<Band>,
}

/// Two curves around a third.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Band {
    /// The lower one.
    pub low: Vec<Option<f64>>,
    /// The upper one.
    pub high: Vec<Option<f64>>,
}
