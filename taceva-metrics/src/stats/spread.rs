//! Spread of bin means, and the part of this spread from chance.

use crate::exact::moments::Moments;
use crate::exact::{Dyadic, ExactSum};
use crate::score::value::{Finished, UndefinedReason};

/// One bin with rounded statistics, computed once for several spreads.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bin {
    n: u64,
    /// m_b, the exact mean of the bin rounded to the nearest binary64 number (RN).
    pub(crate) mean: f64,
    /// RN(Σ (q − m_b)²) over the samples q of the bin.
    squares: f64,
    /// RN(STD), ddof 0.
    deviation: f64,
}

impl Bin {
    /// Bin of these samples; `None` without samples.
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

/// Means m_b of bins, and the scatter within the bins.
///
/// Each m_b is RN of an exact mean. Further arithmetic on these binary64 numbers is exact, except for the roundings marked RN.
#[derive(Clone, Debug, Default)]
pub(crate) struct Spread {
    means: Moments,
    /// RN(Σ (q − m_b)²) of each bin.
    within_squares: ExactSum,
    /// n_b − 1 of each bin.
    within_freedom: u64,
    /// RN(1 / n_b) of each bin.
    shares: ExactSum,
    /// RN(STD) of each bin, ddof 0.
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

    /// μ = RN(Σ m_b / B).
    pub(crate) fn mean(&self) -> Finished {
        self.means.mean().ok_or(self.no_bin())
    }

    /// σ = RN(√RN((B Σ m_b² − (Σ m_b)²) / (B (B − ddof)))).
    pub(crate) fn deviation(&self, ddof: u32) -> Finished {
        let (have, least) = (self.bins(), u64::from(ddof) + 1);
        self.mean()?;
        let deviation = self.means.deviation(u64::from(ddof));
        deviation.ok_or(UndefinedReason::TooFewBins { have, least })
    }

    /// STD of the bin means by chance alone: √(s² mean(1 / n_b)), s² the pooled variance within bins.
    pub(crate) fn noise_floor(&self) -> Finished {
        self.noise_variance().map(f64::sqrt)
    }

    /// STD of the bin means beyond chance: √max(0, variance − noise floor²), with ddof 1.
    pub(crate) fn excess(&self) -> Finished {
        let noise = self.noise_variance()?;
        let variance = self.means.variance(1).ok_or(UndefinedReason::TooFewBins {
            have: self.bins(),
            least: 2,
        })?;
        Ok((variance - noise).max(0.0).sqrt())
    }

    /// RN of the mean of the population STD within each bin.
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
