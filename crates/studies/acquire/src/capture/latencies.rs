//! Histogram of the latency of frames.

/// Upper end of the histogram, in ms. All longer times are in the last bin.
const MOST_MS: usize = 2_000;

/// Histogram of latencies between the time stamp of a frame and its display, with bins of 1 ms.
///
/// ```
/// use taceva_acquire::Latencies;
///
/// let mut latencies = Latencies::default();
/// for milliseconds in 1..=100 {
///     latencies.add(f64::from(milliseconds) / 1000.0 - 0.0005);
/// }
/// assert_eq!(latencies.within_ms(0.95), Some(95));
/// assert_eq!(latencies.share_within(40), Some(0.4));
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Latencies {
    /// Count for each bin of 1 ms. The last bin counts all longer times.
    counts: Vec<u64>,
    total: u64,
}

impl Latencies {
    /// Adds a latency in s. A negative latency, from a stamp in the future, counts as 0.
    pub fn add(&mut self, latency_s: f64) {
        if self.counts.is_empty() {
            self.counts = vec![0; MOST_MS + 1];
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a cast saturates, and NaN becomes 0"
        )]
        let bin = (latency_s * 1000.0).max(0.0) as usize;
        self.counts[bin.min(MOST_MS)] += 1;
        self.total += 1;
    }

    /// Number of latencies added.
    pub fn count(&self) -> u64 {
        self.total
    }

    /// Least whole number of milliseconds within which at least `share` (0 to 1) of the latencies lie. `None` without latencies, or beyond 2 s.
    pub fn within_ms(&self, share: f64) -> Option<u64> {
        #[expect(clippy::cast_precision_loss, reason = "a count, far below 2^53")]
        let wanted = share * self.total as f64;
        let mut sum = 0;
        for (bin, count) in self.counts.iter().enumerate().take(MOST_MS) {
            sum += count;
            #[expect(clippy::cast_precision_loss, reason = "a count, far below 2^53")]
            let is_reached = sum > 0 && sum as f64 >= wanted;
            if is_reached {
                return Some(bin as u64 + 1);
            }
        }
        None
    }

    /// Share (0 to 1) of the latencies up to `milliseconds`; `None` without latencies.
    pub fn share_within(&self, milliseconds: usize) -> Option<f64> {
        let within: u64 = self.counts.iter().take(milliseconds.min(MOST_MS)).sum();
        #[expect(clippy::cast_precision_loss, reason = "counts, far below 2^53")]
        let share = within as f64 / self.total as f64;
        (self.total > 0).then_some(share)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_counted_has_no_share_and_what_took_too_long_is_counted_but_in_no_time() {
        let mut latencies = Latencies::default();
        assert_eq!(
            (latencies.within_ms(0.95), latencies.share_within(100)),
            (None, None)
        );
        latencies.add(9.0);
        latencies.add(f64::NAN);
        latencies.add(-1.0);
        assert_eq!(latencies.count(), 3);
        assert_eq!(latencies.within_ms(0.6), Some(1));
        assert_eq!(latencies.within_ms(0.95), None, "one took 9 s");
        assert_eq!(latencies.share_within(100), Some(2.0 / 3.0));
    }
}
