//! Rate, gaps and noise of the readings of a device at rest.

/// Statistics of the readings of a device.
///
/// # Units
/// Times in ms, rates in Hz, and `noise` in the unit of the reading.
#[derive(Clone, Copy, Debug, Default, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Stream {
    /// Number of readings.
    pub count: usize,
    /// Mean number of readings per second; 0 for fewer than two readings.
    pub rate_hz: f64,
    /// Longest gap between the time stamps of successive readings, in ms.
    pub gap_ms: f64,
    /// Greatest age of a reading on arrival, by its time stamp, in ms; below 0 for stamps of a clock that is ahead.
    pub late_ms: f64,
    /// Greatest standard deviation among the components of a reading, in its unit; `None` for a device without numeric readings.
    pub noise: Option<f64>,
    /// Number of readings lost in transmission, as the driver counts them; `None` if it does not count them. A reading that this host replaced by a
    /// newer reading is not lost.
    pub lost: Option<u64>,
}

/// Collects the times and values of the readings of one device.
#[derive(Clone, Debug, Default)]
pub(super) struct Listener {
    valid_s: Vec<f64>,
    late_s: f64,
    /// Count, mean and sum of squared deviations of each component, updated incrementally (Welford 1962); `None` without values.
    spread: Option<(f64, [f64; 3], [f64; 3])>,
}

impl Listener {
    /// Adds a reading with the time stamp `valid_s` that arrived at `now_s`, both in s.
    pub(super) fn hear(&mut self, valid_s: f64, now_s: f64) {
        let late_s = now_s - valid_s;
        self.late_s = match self.valid_s.is_empty() {
            true => late_s,
            false => self.late_s.max(late_s),
        };
        self.valid_s.push(valid_s);
    }

    /// Adds the three components of a reading.
    pub(super) fn measure(&mut self, read: [f64; 3]) {
        let (count, mean, squares) = self.spread.get_or_insert((0.0, [0.0; 3], [0.0; 3]));
        *count += 1.0;
        for axis in 0..3 {
            let before = read[axis] - mean[axis];
            mean[axis] += before / *count;
            squares[axis] += before * (read[axis] - mean[axis]);
        }
    }

    /// Mean of each component, and the standard error of the last component's mean; `None` without values.
    pub(super) fn mean(&self) -> Option<([f64; 3], f64)> {
        let (count, mean, squares) = self.spread.as_ref()?;
        let variance = squares[2] / (count - 1.0).max(1.0);
        Some((*mean, (variance / count).sqrt()))
    }

    pub(super) fn heard(&self) -> Stream {
        let count = self.valid_s.len();
        let gaps = self.valid_s.windows(2).map(|pair| pair[1] - pair[0]);
        let gap_s = gaps.fold(0.0, f64::max);
        let span_s = match (self.valid_s.first(), self.valid_s.last()) {
            (Some(first), Some(last)) => last - first,
            _ => 0.0,
        };
        let periods = u32::try_from(count.saturating_sub(1)).map_or(f64::INFINITY, f64::from);
        let noise = self.spread.as_ref().map(|(count, _, squares)| {
            let greatest = squares.iter().copied().fold(0.0, f64::max);
            (greatest / (count - 1.0).max(1.0)).sqrt()
        });
        Stream {
            count,
            rate_hz: if span_s > 0.0 { periods / span_s } else { 0.0 },
            gap_ms: gap_s * 1e3,
            late_ms: self.late_s * 1e3,
            noise,
            lost: None,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_stream_is_its_rate_its_longest_gap_its_lateness_and_its_noise() {
        let mut listener = Listener::default();
        for (place, valid_s) in [1.0, 1.01, 1.02, 1.05, 1.06].into_iter().enumerate() {
            listener.hear(valid_s, valid_s + if place == 2 { 0.009 } else { 0.001 });
            let side = if place % 2 == 0 { 1.0 } else { -1.0 };
            listener.measure([0.0, 5.0 + 0.1 * side, 0.05 * side]);
        }
        let stream = listener.heard();
        assert_eq!(stream.count, 5);
        assert!((stream.rate_hz - 4.0 / 0.06).abs() < 1e-6, "{stream:?}");
        assert!((stream.gap_ms - 30.0).abs() < 1e-6, "{stream:?}");
        assert!((stream.late_ms - 9.0).abs() < 1e-6, "{stream:?}");
        // Three times 5.1 and twice 4.9: the variance is 0.012.
        let noise = stream.noise.expect("numbers");
        assert!((noise - 0.012_f64.sqrt()).abs() < 1e-9, "{noise}");
        let mut ahead = Listener::default();
        ahead.hear(31.0, 1.0);
        ahead.hear(31.1, 1.2);
        assert!((ahead.heard().late_ms + 29_900.0).abs() < 1e-6);
        let (mean, error) = listener.mean().expect("numbers");
        assert!((mean[1] - 5.02).abs() < 1e-9, "{mean:?}");
        assert!((error - (0.003_f64 / 5.0).sqrt()).abs() < 1e-9, "{error}");
        assert_eq!(Listener::default().mean(), None);
        assert_eq!(Listener::default().heard(), Stream::default());
    }
}
