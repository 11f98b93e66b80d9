//! Pairs of prediction and truth with named fields. A check of lengths cannot detect swapped arguments.

use taceva_core::Batch;

use crate::error::MetricError;

/// Greatest magnitude of a valid value. Sums, differences and means of two such values stay finite.
pub const GREATEST: f64 = taceva_core::MAGNITUDE_MAX;

/// Constant ε in the denominator of sMAPE (symmetric mean absolute percentage error), in the unit of the channel. With ε, two zeros contribute 0.
pub const EPSILON: f64 = 1e-8;

/// A prediction and its true value, or a column of predictions and the column of their true values. A plain pair, which gets no further fields.
///
/// ```
/// use taceva_metrics::Paired;
/// let pair = Paired { estimate: 0.5, reference: 0.75 };
/// assert_eq!(pair.residual(), 0.25);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Paired<T> {
    /// Prediction of the model, ŷ in formulas.
    pub estimate: T,
    /// True value, measured by the reference instrument; y in formulas.
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

    /// Difference between true value and prediction, rounded to the nearest binary64.
    #[inline]
    pub fn residual(self) -> f64 {
        self.reference - self.estimate
    }

    /// Term |y − ŷ| / ((|y| + |ŷ|) / 2 + ε) of sMAPE, with true value y, prediction ŷ and ε = [`EPSILON`]. Every step is rounded. Two zeros give 0.
    #[inline]
    pub fn symmetric_term(self) -> f64 {
        let scale = (self.reference.abs() + self.estimate.abs()) * 0.5 + EPSILON;
        self.residual().abs() / scale
    }

    /// True if the magnitudes of prediction and true value are at most [`GREATEST`]. Metrics count other pairs as invalid and skip them.
    #[inline]
    pub fn is_valid(self) -> bool {
        is_valid(self.estimate) && is_valid(self.reference)
    }
}

impl Paired<Vec<f64>> {
    /// Borrows the columns of predictions and true values as slices.
    pub fn as_slices(&self) -> Paired<&[f64]> {
        Paired {
            estimate: &self.estimate,
            reference: &self.reference,
        }
    }
}

impl<'a> Paired<&'a [f64]> {
    /// Pairs a column of predictions with a column of true values.
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

    /// Iterates over the pairs of prediction and true value, row by row.
    #[inline]
    pub fn iter(self) -> impl Iterator<Item = Paired<f64>> + 'a {
        let rows = self.estimate.iter().zip(self.reference);
        rows.map(|(&estimate, &reference)| Paired {
            estimate,
            reference,
        })
    }

    /// Splits the columns into blocks of at most `rows` rows.
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
