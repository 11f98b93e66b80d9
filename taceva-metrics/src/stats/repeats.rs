//! Variation of a value over repeats with different random numbers.

use super::student::quantile;
use crate::score::COVERAGE;

/// Statistics of repeated values of one quantity.
///
/// ```
/// let repeats = taceva_metrics::Repeats::of(&[0.9, 1.1]).ok_or("two values")?;
/// assert!(repeats.interval[0] < repeats.mean);
/// # Ok::<(), &str>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Repeats {
    /// Mean of the values.
    pub mean: f64,
    /// Sample standard deviation, with n − 1 degrees of freedom.
    pub standard_deviation: f64,
    /// 95 % confidence interval of the true mean (Student's t; assumes normal values).
    pub interval: [f64; 2],
}

impl Repeats {
    /// Statistics of `values`; `None` for fewer than two values, or if a value is not finite.
    ///
    /// ```
    /// let repeats = taceva_metrics::Repeats::of(&[1.0, 2.0, 3.0]).expect("three");
    /// assert_eq!((repeats.mean, repeats.standard_deviation), (2.0, 1.0));
    /// // 4.3027 is Student's t of two degrees of freedom.
    /// assert!((repeats.interval[1] - 2.0 - 4.3027 / 3_f64.sqrt()).abs() < 1e-4);
    /// assert_eq!(taceva_metrics::Repeats::of(&[1.0]), None);
    /// ```
    pub fn of(values: &[f64]) -> Option<Repeats> {
        if values.len() < 2 || values.iter().any(|value| !value.is_finite()) {
            return None;
        }
        let count = values.len() as f64;
        let are_equal = values
            .windows(2)
            .all(|pair| pair[0].to_bits() == pair[1].to_bits());
        // Rounding may change the mean of equal values: (0.1 + 0.1 + 0.1) / 3.
        let mean = match are_equal {
            true => values[0],
            false => values.iter().sum::<f64>() / count,
        };
        let squares = values.iter().map(|value| (value - mean) * (value - mean));
        let variance = squares.sum::<f64>() / (count - 1.0);
        let half = quantile(COVERAGE, count - 1.0) * (variance / count).sqrt();
        let repeats = Repeats {
            mean,
            standard_deviation: variance.sqrt(),
            interval: [mean - half, mean + half],
        };
        (mean.is_finite() && half.is_finite()).then_some(repeats)
    }

    /// The same statistics, with the interval limited to the possible range of the quantity.
    pub fn within(self, [least, greatest]: [f64; 2]) -> Repeats {
        Repeats {
            interval: self.interval.map(|end| end.clamp(least, greatest)),
            ..self
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_repeats_leave_an_interval_of_no_width() {
        // The sum of three 0.1 is not three times 0.1.
        for values in [&[0.25; 4][..], &[0.1; 3], &[0.7; 3]] {
            let repeats = Repeats::of(values).expect("several");
            let ends = repeats.interval.map(f64::to_bits);
            assert_eq!(ends, [values[0].to_bits(); 2]);
            assert_eq!(repeats.mean.to_bits(), values[0].to_bits());
            assert_eq!(repeats.standard_deviation.to_bits(), 0);
        }
        assert_eq!(Repeats::of(&[1.0, f64::NAN]), None);
    }

    #[test]
    fn no_end_leaves_what_the_quantity_can_be() {
        let repeats = Repeats::of(&[0.9, 0.999]).expect("two");
        assert!(repeats.interval[1] > 1.0);
        assert_eq!(
            repeats.within([f64::MIN, 1.0]).interval[1].to_bits(),
            1_f64.to_bits()
        );
    }
}
