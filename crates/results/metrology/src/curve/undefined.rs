//! Reasons why a curve or one of its figures is undefined.

/// Reason why a curve or a figure is undefined.
///
/// ```
/// use taceva_metrology::curve::CurveUndefined;
/// assert_eq!(CurveUndefined::EqualX.to_string(), "all x are equal, expected at least two different values");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum CurveUndefined {
    /// The order is not 1, 2 or 3.
    #[error("order {0} is found, expected 1, 2 or 3")]
    Order(usize),
    /// Too few rows: no degree of freedom remains.
    #[error("{}, expected {least} or more", taceva_core::counted(*have, "row"))]
    TooFewRows {
        /// Number of rows.
        have: usize,
        /// Least number of rows.
        least: usize,
    },
    /// All x are equal.
    #[error("all x are equal, expected at least two different values")]
    EqualX,
    /// Fewer distinct x than coefficients.
    #[error("{} of x, expected {least} or more", taceva_core::counted(*have, "different value"))]
    TooFewX {
        /// Number of distinct x.
        have: usize,
        /// Least number of distinct x.
        least: usize,
    },
    /// A row has a number that is not finite.
    #[error("row {row} has a number that is not finite, expected finite numbers")]
    NotFinite {
        /// Row, from 1.
        row: usize,
    },
    /// A probability outside 0..1.
    #[error("probability {0} is found, expected a number between 0 and 1")]
    Probability(f64),
    /// The slope does not differ significantly from 0, so the interval of the inverse is unbounded.
    #[error("the slope is not shown to differ from 0: Fieller's g is {g:.3}, expected below 1")]
    SlopeNotShown {
        /// Fieller's g = (t u(b)/b)², at least 1, for Student's t and the slope b with standard uncertainty u(b).
        g: f64,
    },
    /// The figure is defined only for a line; the value is the order of the curve.
    #[error("order {0} is found, expected 1: the figure is defined for a straight line")]
    NotALine(usize),
    /// A force, a reading or a resolution that must be above 0.
    #[error("{what} {value} is found, expected a number above 0")]
    NotPositive {
        /// Name of the quantity.
        what: &'static str,
        /// Value found.
        value: f64,
    },
    /// A series whose number of levels differs from the number of forces.
    #[error("series {series} has {}, expected {expected}", taceva_core::counted(*have, "level"))]
    Levels {
        /// Name of the series.
        series: &'static str,
        /// Number of levels of the series.
        have: usize,
        /// Number of forces.
        expected: usize,
    },
    /// A missing series, by name.
    #[error("series {0} is missing")]
    MissingSeries(&'static str),
}

/// Returns `p` if it is in 0..1.
pub(super) fn probability(p: f64) -> Result<f64, CurveUndefined> {
    (p > 0.0 && p < 1.0)
        .then_some(p)
        .ok_or(CurveUndefined::Probability(p))
}

/// Checks that all `values` are positive and finite.
pub(super) fn all_positive<'a>(
    what: &'static str,
    values: impl IntoIterator<Item = &'a f64>,
) -> Result<(), CurveUndefined> {
    let mut values = values.into_iter();
    values.try_for_each(|value| positive(what, *value).map(|_| ()))
}

/// Range of `values`: greatest minus least value.
pub(super) fn range(values: &[f64]) -> f64 {
    let greatest = values.iter().copied().fold(f64::MIN, f64::max);
    greatest - values.iter().copied().fold(f64::MAX, f64::min)
}

/// Returns `value` if it is positive and finite.
pub(super) fn positive(what: &'static str, value: f64) -> Result<f64, CurveUndefined> {
    let is_right = value > 0.0 && value.is_finite();
    is_right
        .then_some(value)
        .ok_or(CurveUndefined::NotPositive { what, value })
}
