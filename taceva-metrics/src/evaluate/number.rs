//! Number types that a caller may pass.

/// A number of a row: `f64`, `f32`, a reference to one of them, or an `Option` of any, `None` where the sample has no value.
///
/// Any iterator over such numbers is a column: a slice, a vector, an array, a view of `ndarray`. An `f32` is widened without loss.
///
/// ```
/// use taceva_metrics::Number;
/// assert_eq!((0.5_f32.number(), (&0.5).number(), None::<f64>.number()), (Some(0.5), Some(0.5), None));
/// ```
pub trait Number: Copy {
    /// The number in binary64; `None` if there is none.
    ///
    /// ```
    /// use taceva_metrics::Number;
    /// assert_eq!(Some(0.25_f32).number(), Some(0.25));
    /// ```
    fn number(self) -> Option<f64>;

    /// `values` without a copy, if they are binary64 already.
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
