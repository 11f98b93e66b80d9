//! The two sides of a comparison.

use std::fmt;

/// Values of both sides of a comparison. A plain pair, which gets no further fields.
///
/// ```
/// use taceva_metrics::Sides;
/// let errors = Sides { a: 0.041, b: 0.053 };
/// assert!(errors.a < errors.b);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Sides<T> {
    /// Value of side A, the minuend of the difference.
    pub a: T,
    /// Value of side B, the subtrahend of the difference.
    pub b: T,
}

impl<T> Sides<T> {
    /// Converts both sides; returns the first error.
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

/// One side of a comparison. This type gets no further variant: a comparison has two sides.
///
/// ```
/// assert_eq!(taceva_metrics::Side::A.to_string(), "A");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Side {
    /// The minuend of the difference.
    A,
    /// The subtrahend of the difference.
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
