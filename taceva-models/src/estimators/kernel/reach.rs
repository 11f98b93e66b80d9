//! Calibration of predictive standard deviations.

/// The 97.5 % quantile of the standard normal distribution. 95 % of normal errors are at most this many standard deviations.
pub const NORMAL_95: f64 = 1.959_963_984_540_054;

/// Minimum number of errors for a 95 % quantile.
const ENOUGH: usize = 19;

/// Factor by which predicted standard deviations of a channel must be multiplied. The errors of 95 % of held-out samples then lie within 1.96
/// deviations.
///
/// `misses` are errors of held-out samples divided by their predicted deviations. Returns 1 for too few samples or if the quantile is 0.
///
/// # Reference
/// J. Lei et al., J. Am. Stat. Assoc. 113 (2018) 1094, sec. 5.2: split conformal intervals, weighted locally.
pub(super) fn reach(mut misses: Vec<f64>) -> f64 {
    if misses.len() < ENOUGH {
        return 1.0;
    }
    misses.iter_mut().for_each(|miss| *miss = miss.abs());
    misses.sort_by(f64::total_cmp);
    // Rank of the 95 % quantile of n + 1 samples.
    let rank = ((misses.len() + 1) * 19).div_ceil(20).min(misses.len());
    let factor = misses[rank - 1] / NORMAL_95;
    if factor > 0.0 && factor.is_finite() {
        factor
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nineteen_of_twenty_lie_within_the_stated_reach() {
        let misses: Vec<f64> = (1..=100).map(|number| -0.1 * f64::from(number)).collect();
        let factor = reach(misses.clone());
        let inside = |miss: &&f64| miss.abs() <= factor * NORMAL_95;
        assert_eq!(misses.iter().filter(inside).count(), 96);
        // Nineteen samples are enough, an empty list is not.
        assert!((reach(vec![3.0; 19]) - 3.0 / NORMAL_95).abs() < 1e-12);
        for nothing in [vec![3.0; 18], vec![0.0; 40], vec![f64::NAN; 40]] {
            assert!((reach(nothing) - 1.0).abs() < 1e-12);
        }
    }
}
