//! Types of the numbers in a column that metrics read: `f64`, `f32`, references to them, and optional numbers.

/// Number type of a column: `f64`, `f32`, a reference to one of them, or an `Option` with `None` for a missing value.
///
/// Any iterator over numbers of this trait is a column: a slice, a vector, an array, a view of `ndarray`. An `f32` is widened without loss.
///
/// ```
/// use taceva_metrics::Number;
/// assert_eq!((0.5_f32.number(), (&0.5).number(), None::<f64>.number()), (Some(0.5), Some(0.5), None));
/// ```
pub trait Number: Copy {
    /// The number in binary64; `None` for a missing value.
    ///
    /// ```
    /// use taceva_metrics::Number;
    /// assert_eq!(Some(0.25_f32).number(), Some(0.25));
    /// ```
    fn number(self) -> Option<f64>;

    /// Borrows `values` without a copy; `None` if they are not binary64.
    #[doc(hidden)]
    fn doubles(_values: &[Self]) -> Option<&[f64]> {
        None
    }
}

impl Number for f64 {
    fn number(self) -> Option<f64> {
        Some(self)
    }

    fn doubles(values: &[f64]) -> Option<&[f64]> {
        Some(values)
    }
}

impl Number for f32 {
    fn number(self) -> Option<f64> {
        Some(f64::from(self))
    }
}

impl<T: Number> Number for &T {
    fn number(self) -> Option<f64> {
        (*self).number()
    }
}

impl<T: Number> Number for Option<T> {
    fn number(self) -> Option<f64> {
        self.and_then(Number::number)
    }
}
