//! Curves: values over the levels of another quantity.

use taceva_core::Unit;

/// Values at ascending levels of another quantity. A missing value is `None`, never a placeholder.
///
/// # Shapes
/// `x`, `values` and `counts` have equal length, and so has `band` if present.
/// # Units
/// Levels in `x_unit`; values in the unit of the [`Variant`](crate::Variant) with the curve.
///
/// ```
/// use taceva_metrics::{Band, Curve, Unit};
/// let curve = Curve::new(vec![0.5, 1.0], Unit::Newton, vec![Some(0.1), None], vec![9, 0]);
/// let curve = curve.with_band(Band { low: vec![Some(0.0), None], high: vec![Some(0.2), None] });
/// assert_eq!((curve.x.len(), curve.band.is_some()), (2, true));
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Curve {
    /// Levels of the other quantity, ascending.
    pub x: Vec<f64>,
    /// The unit of the levels.
    pub x_unit: Unit,
    /// The value at each level.
    pub values: Vec<Option<f64>>,
    /// Number of samples of each value.
    pub counts: Vec<u64>,
    /// Lower and upper curve around the values, as the metric defines them; `None` without a band.
    pub band: Option<Band>,
}

impl Curve {
    /// Curve through `values` at the levels `x`, without a band. The caller must check the shapes.
    pub fn new(x: Vec<f64>, x_unit: Unit, values: Vec<Option<f64>>, counts: Vec<u64>) -> Curve {
        Curve {
            x,
            x_unit,
            values,
            counts,
            band: None,
        }
    }

    /// Returns the curve with `band` around its values.
    #[must_use]
    pub fn with_band(self, band: impl Into<Option<Band>>) -> Curve {
        Curve {
            band: band.into(),
            ..self
        }
    }
}

/// Lower and upper curve around the values of a [`Curve`]. A plain pair: it gets no further fields.
///
/// ```
/// use taceva_metrics::Band;
/// let band = Band { low: vec![Some(0.1), None], high: vec![Some(0.3), None] };
/// assert_eq!(band.low.len(), band.high.len());
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Band {
    /// Values of the lower curve, one per level.
    pub low: Vec<Option<f64>>,
    /// Values of the upper curve, one per level.
    pub high: Vec<Option<f64>>,
}
