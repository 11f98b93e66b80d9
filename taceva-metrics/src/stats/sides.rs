//! The two that are compared, by name.

use std::fmt;

/// What there is of each of the two that are compared: a plain pair, which gets no further fields.
///
/// ```
/// use taceva_metrics::Sides;
/// let errors = Sides { a: 0.041, b: 0.053 };
/// assert!(errors.a < errors.b);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sides<T> {
    /// Of the one from which the other is subtracted.
    pub a: T,
    /// Of the other.
    pub b: T,
}

impl<T> Sides<T> {
    /// What `convert` makes of each, or the first error.
    pub(crate) fn try_map<U, E>(
        self,
        mut convert: impl FnMut(Side, T) -> Result<U, E>,
    ) -> Result<Sides<U>, E> {
        Ok(Sides {
            a: convert(Side::A, self.a)?,
            b: convert(Side::B, self.b)?,
        })
    }
}

/// One of the two that are compared. It gets no further variant: a comparison has two sides.
///
/// ```
/// assert_eq!(taceva_metrics::Side::A.to_string(), "A");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The one from which the other is subtracted.
    A,
    /// The other.
    B,
}

impl fmt::Display for Side {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Side::A => "A",
            Side::B => "B",
        })
    }
}
