//! Spread of bin means, and the part of this spread from chance.

use crate::exact::moments::Moments;
use crate::exact::{Dyadic, ExactSum};
use crate::score::value::{Finished, UndefinedReason};

/// Rounded statistics of the samples in one bin.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bin {
    n: u64,
    /// Mean of the samples, rounded once.
    pub(crate) mean: f64,
    /// Sum of squared deviations from the exact mean, rounded once.
    squares: f64,
    /// Standard deviation with the divisor n.
    deviation: f64,
}

impl Bin {
    /// Bin with the samples of `moments`; `None` without samples.
    pub(crate) fn of(moments: &Moments) -> Option<Bin> {
        Some(Bin {
            n: moments.n,
            mean: moments.mean()?,
            squares: moments.squared_deviations()?,
            deviation: moments.deviation(0)?,
        })
    }

    /// True if the bin has at least `n_min` samples.
    pub(crate) fn has(&self, n_min: u64) -> bool {
        self.n >= n_min
    }
}

/// Rounded means of bins, and the scatter within the bins, as exact sums.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spread {
    means: Moments,
    /// Sum over the bins of the squared deviations within each bin.
    within_squares: ExactSum,
    /// Sum over the bins of the number of samples minus 1.
    within_freedom: u64,
    /// Sum over the bins of 1 / n, with the number n of samples in the bin. Each quotient is rounded; their sum is exact.
    shares: ExactSum,
    /// Sum over the bins of the standard deviation within each bin, with the divisor n.
    deviations: ExactSum,
    /// True if the scatter of a bin exceeds the range of binary64.
    overflow: bool,
    n_min: u64,
}

impl Spread {
    /// Spread of the `bins` with at least `n_min` samples.
    pub(crate) fn of(bins: &[Bin], n_min: u64) -> Spread {
        let mut spread = Spread {
            n_min,
            ..Spread::default()
        };
        for bin in bins.iter().filter(|bin| bin.has(n_min)) {
            spread.add(bin);
        }
        spread
    }

    fn add(&mut self, bin: &Bin) {
        self.means.add(bin.mean);
        self.shares.add(Dyadic::from(1).over(&Dyadic::from(bin.n)));
        self.within_freedom = self.within_freedom.saturating_add(bin.n - 1);
        if bin.squares.is_finite() {
            self.within_squares.add(bin.squares);
            self.deviations.add(bin.deviation);
        } else {
            self.overflow = true;
        }
    }

    /// Number of bins with enough samples.
    pub(crate) fn bins(&self) -> u64 {
        self.means.n
    }

    /// Mean of the bin means, rounded once.
    pub(crate) fn mean(&self) -> Finished {
        self.means.mean().ok_or(self.no_bin())
    }

    /// Standard deviation of the bin means, with the divisor number of bins − `ddof`.
    pub(crate) fn deviation(&self, ddof: u32) -> Finished {
        let (have, least) = (self.bins(), u64::from(ddof) + 1);
        self.mean()?;
        let deviation = self.means.deviation(u64::from(ddof));
        deviation.ok_or(UndefinedReason::TooFewBins { have, least })
    }

    /// Standard deviation of the bin means by chance alone: √(s² × mean of 1 / n over the bins). A bin has n samples, and s² is the pooled variance
    /// within bins.
    pub(crate) fn noise_floor(&self) -> Finished {
        self.noise_variance().map(f64::sqrt)
    }

    /// Standard deviation of the bin means beyond chance: √max(0, sample variance − noise floor²).
    pub(crate) fn excess(&self) -> Finished {
        let noise = self.noise_variance()?;
        let variance = self.means.variance(1).ok_or(UndefinedReason::TooFewBins {
            have: self.bins(),
            least: 2,
        })?;
        Ok((variance - noise).max(0.0).sqrt())
    }

    /// Mean over the bins of the standard deviation within each bin, rounded once.
    pub(crate) fn within(&self) -> Finished {
        if self.overflow {
            return Err(UndefinedReason::Overflow);
        }
        self.mean()?;
        Ok(self.deviations.to_dyadic().over(&Dyadic::from(self.bins())))
    }

    fn noise_variance(&self) -> Finished {
        if self.overflow {
            return Err(UndefinedReason::Overflow);
        }
        self.mean()?;
        if self.within_freedom == 0 {
            return Err(UndefinedReason::NoRepeats);
        }
        let pooled = self.within_squares.to_dyadic();
        let pooled = pooled.over(&Dyadic::from(self.within_freedom));
        let share = self.shares.to_dyadic().over(&Dyadic::from(self.bins()));
        Ok(pooled * share)
    }

    fn no_bin(&self) -> UndefinedReason {
        UndefinedReason::NoBin { least: self.n_min }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn bins(values: &[&[f64]]) -> Vec<Bin> {
        let bin = |values: &&[f64]| Bin::of(&values.iter().copied().collect());
        values.iter().filter_map(bin).collect()
    }

    fn close(found: Finished, expected: f64) {
        let found = found.expect("a number");
        // A few roundings of numbers near 1.
        assert!(
            (found - expected).abs() < 1e-15,
            "{found} is not {expected}"
        );
    }

    #[test]
    fn a_hand_calculation_with_three_bins() {
        // Means 2, 4, 6; squares within 2, 0, 2 with freedom 1, 0, 1; pooled variance 2; mean of 1/n is (1/2 + 1 + 1/2) / 3.
        let bins = bins(&[&[1.0, 3.0], &[4.0], &[5.0, 7.0]]);
        let spread = Spread::of(&bins, 1);
        close(spread.mean(), 4.0);
        close(spread.deviation(0), (8.0_f64 / 3.0).sqrt());
        close(spread.noise_floor(), (4.0_f64 / 3.0).sqrt());
        close(spread.excess(), (4.0_f64 - 4.0 / 3.0).sqrt());
        close(spread.within(), 2.0 / 3.0);
        assert_eq!(Spread::of(&bins, 2).bins(), 2);
    }

    #[test]
    fn bins_of_one_sample_leave_chance_unknown() {
        let bins = bins(&[&[1.0], &[2.0]]);
        let spread = Spread::of(&bins, 1);
        assert_eq!(spread.noise_floor(), Err(UndefinedReason::NoRepeats));
        assert_eq!(
            Spread::of(&bins, 2).mean(),
            Err(UndefinedReason::NoBin { least: 2 })
        );
    }

    #[test]
    fn scatter_beyond_binary64_is_an_overflow_and_no_panic() {
        let large = 2.0_f64.powi(1020);
        let bins = bins(&[&[large, -large], &[0.0, 1.0]]);
        let spread = Spread::of(&bins, 1);
        assert_eq!(spread.noise_floor(), Err(UndefinedReason::Overflow));
        assert_eq!(spread.within(), Err(UndefinedReason::Overflow));
    }
}
