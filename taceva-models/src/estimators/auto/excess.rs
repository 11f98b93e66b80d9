//! Comparison of two models by their losses on the same units, which are groups or runs of samples.

/// Number of standard errors of a difference above which a model is clearly better. The best of a dozen equal models is often two standard errors
/// ahead by chance.
pub(super) const CLEARLY: f64 = 3.0;
/// Number of standard errors by which a network must be better than the best other model, or that model better than the baseline.
pub(super) const BEYOND_CHANCE: f64 = 2.0;

/// Mean difference between the losses of two models, over groups or runs of samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct Excess {
    mean: f64,
    /// Standard error of the mean; infinite for fewer than two differences.
    standard_error: f64,
}

impl Excess {
    /// Computes the mean and standard error of the differences `losses` − `others`.
    pub(super) fn of(losses: &[f64], others: &[f64]) -> Excess {
        let differences = losses.iter().zip(others).map(|(own, other)| own - other);
        let differences: Vec<f64> = differences.collect();
        let mean = mean(&differences);
        let count = differences.len() as f64;
        let squares: f64 = differences.iter().map(|own| (own - mean).powi(2)).sum();
        Excess {
            mean,
            standard_error: match differences.len() {
                0 | 1 => f64::INFINITY,
                _ => (squares / (count * (count - 1.0))).sqrt(),
            },
        }
    }

    /// True if the mean difference is greater than `standard_errors` times its standard error.
    pub(super) fn is_beyond(self, standard_errors: f64) -> bool {
        self.standard_error.is_finite() && self.mean > standard_errors * self.standard_error
    }
}

/// Mean of `values`; 0 if `values` is empty.
pub(super) fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len().max(1) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_difference_counts_where_it_exceeds_what_units_scatter_by() {
        let plain = [0.5, 0.7, 0.4, 0.6];
        let better = plain.map(|loss| loss - 0.1);
        assert!(Excess::of(&plain, &better).is_beyond(CLEARLY));
        assert!(!Excess::of(&better, &plain).is_beyond(0.0));
        // The same mean, by chance.
        let scattered = [0.1, 0.9, 0.0, 0.8];
        assert!(Excess::of(&plain, &scattered).is_beyond(0.0));
        assert!(!Excess::of(&plain, &scattered).is_beyond(BEYOND_CHANCE));
        assert!(!Excess::of(&plain, &plain).is_beyond(0.0));
        assert!(!Excess::of(&[1.0], &[0.0]).is_beyond(0.0));
    }
}
