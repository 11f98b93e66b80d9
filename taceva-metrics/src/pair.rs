//! Predictions and truths with named roles, because no check of shapes detects swapped arguments.

use taceva_core::Batch;

use crate::error::MetricError;

/// Greatest magnitude of a sample's value: sums, differences and means of two such values stay finite.
pub const GREATEST: f64 = taceva_core::MAGNITUDE_MAX;

/// ε of sMAPE, the binary64 nearest to 10⁻⁸, in the unit of the channel. With ε the term of two zeros is 0.
pub const EPSILON: f64 = 1e-8;

/// An estimate and its reference: two values, or two columns. A plain pair, which gets no further fields.
///
/// ```
/// use taceva_metrics::Paired;
/// let pair = Paired { estimate: 0.5, reference: 0.75 };
/// assert_eq!(pair.residual(), 0.25);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Paired<T> {
    /// ŷ: the prediction of the model.
    pub estimate: T,
    /// y: the truth measured by the reference instrument.
    pub reference: T,
}

impl Paired<f64> {
    /// Prediction and truth of the channel at index `channel` in row `row` of `batch`; `None` if either is absent.
    pub(crate) fn at(batch: &Batch, channel: usize, row: usize) -> Option<Paired<f64>> {
        Some(Paired {
            estimate: batch.prediction(channel).get(row)?,
            reference: batch.truth(channel).get(row)?,
        })
    }

    /// d = RN(y − ŷ): y − ŷ, rounded to the nearest binary64.
    #[inline]
    pub fn residual(self) -> f64 {
        self.reference - self.estimate
    }

    /// Term |d| / ((|y| + |ŷ|) / 2 + ε) of sMAPE, rounded at every step; 0 for two zeros, because of ε.
    #[inline]
    pub fn symmetric_term(self) -> f64 {
        let scale = (self.reference.abs() + self.estimate.abs()) * 0.5 + EPSILON;
        self.residual().abs() / scale
    }

    /// True if both magnitudes are at most [`GREATEST`]. Other pairs are counted as invalid and skipped.
    #[inline]
    pub fn is_valid(self) -> bool {
        is_valid(self.estimate) && is_valid(self.reference)
    }
}

impl Paired<Vec<f64>> {
    /// Borrows both columns.
    pub fn as_slices(&self) -> Paired<&[f64]> {
        Paired {
            estimate: &self.estimate,
            reference: &self.reference,
        }
    }
}

impl<'a> Paired<&'a [f64]> {
    /// Two columns of one length.
    ///
    /// # Errors
    /// [`MetricError::Lengths`] if the lengths differ.
    pub fn try_columns(
        estimate: &'a [f64],
        reference: &'a [f64],
    ) -> Result<Paired<&'a [f64]>, MetricError> {
        if estimate.len() != reference.len() {
            return Err(MetricError::Lengths {
                estimate: estimate.len(),
                reference: reference.len(),
            });
        }
        Ok(Paired {
            estimate,
            reference,
        })
    }

    /// The pairs, row by row.
    #[inline]
    pub fn iter(self) -> impl Iterator<Item = Paired<f64>> + 'a {
        let rows = self.estimate.iter().zip(self.reference);
        rows.map(|(&estimate, &reference)| Paired {
            estimate,
            reference,
        })
    }

    /// The pairs in blocks of at most `rows`.
    pub(crate) fn blocks(self, rows: usize) -> impl Iterator<Item = Paired<&'a [f64]>> {
        let blocks = self.estimate.chunks(rows).zip(self.reference.chunks(rows));
        blocks.map(|(estimate, reference)| Paired {
            estimate,
            reference,
        })
    }
}

/// True if the magnitude of `value` is at most [`GREATEST`].
#[inline]
pub(crate) fn is_valid(value: f64) -> bool {
    value.abs() <= GREATEST
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_greatest_value_is_two_to_the_1021() {
        assert_eq!(GREATEST.to_bits(), 2.0_f64.powi(1021).to_bits());
        assert!(
            is_valid(-GREATEST)
                && !is_valid(f64::from_bits(GREATEST.to_bits() + 1))
                && !is_valid(f64::NAN)
        );
    }

    #[test]
    fn columns_of_two_lengths_are_refused() {
        let error = Paired::try_columns(&[1.0], &[]).expect_err("one and none");
        assert_eq!(
            error.to_string(),
            "1 estimates and 0 references, expected equal numbers"
        );
    }

    #[test]
    fn two_zeros_differ_by_nothing() {
        let pair = Paired {
            estimate: -0.0,
            reference: 0.0,
        };
        assert_eq!(pair.symmetric_term().to_bits(), 0.0_f64.to_bits());
    }
}
