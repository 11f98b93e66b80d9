//! Count, sum and sum of squares, for mean and spread with a single rounding.

use crate::exact::merge::Merge;
use crate::exact::record::Record;
use crate::exact::{Dyadic, ExactSum};

/// Count and exact sums of values and of their squares.
///
/// ```
/// use taceva_metrics::Moments;
/// let mut first: Moments = [1.0, 2.0].into_iter().collect();
/// let second: Moments = [4.0].into_iter().collect();
/// first.merge(&second);
/// assert_eq!((first.n, first.mean()), (3, Some(7.0 / 3.0)));
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct Moments {
    /// Number of values.
    pub n: u64,
    /// Sum of the values.
    pub sum: ExactSum,
    /// Sum of the squares of the values.
    pub squares: ExactSum,
}

impl Moments {
    /// Adds a finite `value`.
    pub fn add(&mut self, value: f64) {
        self.n += 1;
        self.sum.add(value);
        self.squares.add_product(value, value);
    }

    /// Adds the values of `other`.
    pub fn merge(&mut self, other: &Moments) {
        self.n = self.n.saturating_add(other.n);
        self.sum.merge(&other.sum);
        self.squares.merge(&other.squares);
    }

    /// Mean, rounded once; `None` for no value.
    pub fn mean(&self) -> Option<f64> {
        (self.n > 0).then(|| self.sum.to_dyadic().over(&Dyadic::from(self.n)))
    }

    /// Variance of the n values, with the divisor n − `ddof`, rounded once; `None` for `ddof` values or fewer.
    pub(crate) fn variance(&self, ddof: u64) -> Option<f64> {
        let freedom = self.n.checked_sub(ddof).filter(|freedom| *freedom > 0)?;
        Some(
            self.scaled_spread()
                .over(&(&Dyadic::from(self.n) * &Dyadic::from(freedom))),
        )
    }

    /// Standard deviation: root of the rounded [`variance`](Moments::variance); `None` for `ddof` values or fewer.
    pub(crate) fn deviation(&self, ddof: u64) -> Option<f64> {
        self.variance(ddof).map(f64::sqrt)
    }

    /// Sum of squared deviations from the exact mean, rounded once; `None` for no value.
    pub(crate) fn squared_deviations(&self) -> Option<f64> {
        (self.n > 0).then(|| self.scaled_spread().over(&Dyadic::from(self.n)))
    }

    /// n Σ q² − (Σ q)² of the n values q, exactly.
    pub(crate) fn scaled_spread(&self) -> Dyadic {
        let sum = self.sum.to_dyadic();
        &(&Dyadic::from(self.n) * &self.squares.to_dyadic()) - &(&sum * &sum)
    }

    /// Converts the moments to the record of a state: count, sum and sum of squares.
    pub(crate) fn to_record(&self) -> Record {
        Record {
            counts: vec![self.n],
            sums: vec![self.sum.clone(), self.squares.clone()],
            ..Record::default()
        }
    }

    /// Reads moments from the record of a state.
    pub(crate) fn read_record(record: &Record) -> Result<Moments, String> {
        let ([n], [sum, squares]) = record.exactly()?;
        Ok(Moments {
            n: *n,
            sum: sum.clone(),
            squares: squares.clone(),
        })
    }
}

impl Merge for Moments {
    fn merge(&mut self, other: &Moments) {
        Moments::merge(self, other);
    }
}

impl FromIterator<f64> for Moments {
    fn from_iter<I: IntoIterator<Item = f64>>(values: I) -> Moments {
        let mut moments = Moments::default();
        values.into_iter().for_each(|value| moments.add(value));
        moments
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_of_small_integers_are_their_fractions() {
        let moments: Moments = [1.0, 2.0, 4.0].into_iter().collect();
        let bits = |value: Option<f64>| value.map(f64::to_bits);
        assert_eq!(bits(moments.mean()), bits(Some(7.0 / 3.0)));
        assert_eq!(bits(moments.variance(0)), bits(Some(14.0 / 9.0)));
        assert_eq!(bits(moments.variance(1)), bits(Some(7.0 / 3.0)));
        assert_eq!(bits(moments.squared_deviations()), bits(Some(14.0 / 3.0)));
    }

    #[test]
    fn equal_values_have_no_spread_at_all() {
        let moments: Moments = [0.1; 7].into_iter().collect();
        assert_eq!(moments.deviation(0).map(f64::to_bits), Some(0));
    }

    #[test]
    fn nothing_and_one_value_have_no_spread_to_estimate() {
        let one: Moments = [3.0].into_iter().collect();
        assert_eq!((one.variance(1), one.variance(0)), (None, Some(0.0)));
        assert_eq!(Moments::default().mean(), None);
        assert_eq!(Moments::default().squared_deviations(), None);
    }
}
