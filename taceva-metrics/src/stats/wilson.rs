//! Wilson interval of a share of independent trials.

use crate::count::as_f64;
use crate::score::Interval;

/// Standard normal quantile z: ±z contains 95 % of the normal distribution.
const Z: f64 = 1.959_963_984_540_054;

/// Wilson's interval of the share `hits` / `trials`, for at least one trial. All trials are independent.
///
/// # Reference
/// Wilson, Probable inference, the law of succession, and statistical inference, JASA 22 (1927).
pub(crate) fn interval(hits: u64, trials: u64) -> Interval {
    let n = as_f64(trials);
    let [low, high] = ends(as_f64(hits) / n, n, Z);
    Interval::Wilson { low, high }
}

impl Interval {
    /// Wilson's interval of the share `hits` / `trials`, which assumes independent trials.
    ///
    /// ```
    /// use taceva_metrics::Interval;
    /// let [low, high] = Interval::wilson(1229, 1500).ends().ok_or("1500 trials")?;
    /// assert!((low - 0.7991).abs() < 5e-5 && (high - 0.8380).abs() < 5e-5);
    /// # Ok::<(), &str>(())
    /// ```
    ///
    /// # Panics
    /// If there is no trial, or more hits than trials.
    #[must_use]
    pub fn wilson(hits: u64, trials: u64) -> Interval {
        assert!(
            trials > 0 && hits <= trials,
            "{hits} hits of {trials} trials"
        );
        interval(hits, trials)
    }
}

/// Ends of Wilson's interval: the true shares from which `share` is `z` standard errors away. The number `n` of trials may be fractional.
pub(super) fn ends(share: f64, n: f64, z: f64) -> [f64; 2] {
    let scale = 1.0 + z * z / n;
    let centre = (share + z * z / (2.0 * n)) / scale;
    let spread = share * (1.0 - share) / n + z * z / (4.0 * n * n);
    let half = z * spread.sqrt() / scale;
    // At the ends the formula gives 0 and 1 up to rounding.
    [
        if share <= 0.0 { 0.0 } else { centre - half },
        if share >= 1.0 { 1.0 } else { centre + half },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_hits_in_twenty_lie_where_tables_say() {
        let [low, high] = interval(10, 20).ends().expect("an interval");
        // Half of the last printed decimal.
        assert!(
            (low - 0.299_30).abs() < 5e-6 && (high - 0.700_70).abs() < 5e-6,
            "{low} {high}"
        );
    }

    #[test]
    fn no_hit_and_no_miss_stay_within_a_share() {
        let [low, high] = interval(0, 10).ends().expect("an interval");
        assert!(low <= 0.0 && (high - 0.277_53).abs() < 5e-6, "{high}");
        let [low, high] = interval(10, 10).ends().expect("an interval");
        assert!(high >= 1.0 && (low - 0.722_47).abs() < 5e-6, "{low}");
    }
}
