//! Time intervals between frames.

use super::sums::IntrinsicSums;
use crate::exact::Dyadic;
use crate::exact::moments::Moments;
use crate::score::value::{Finished, UndefinedReason};

/// Intervals between successive frames, s, sorted from short to long.
pub(super) struct Intervals {
    sorted: Vec<f64>,
}

/// Greatest median interval of a stream of frames, s. Longer intervals are the pace of a robot, not of a camera.
pub const STREAM_S: f64 = 1.0;
/// Ratio of an interval to the median above which the interval is a gap.
const GAP: f64 = 1.5;

impl Intervals {
    /// Computes the differences of successive times, each rounded once.
    ///
    /// # Errors
    /// [`UndefinedReason`] for fewer than two different times, or a median interval above [`STREAM_S`].
    pub(super) fn of(sums: &IntrinsicSums) -> Result<Intervals, UndefinedReason> {
        match sums.times_s()[..] {
            [] => Err(UndefinedReason::NoTimes),
            [_] if sums.timed() == 1 => Err(UndefinedReason::TooFew { least: 2 }),
            [_] => Err(UndefinedReason::EqualTimes),
            ref times => {
                let mut sorted: Vec<f64> = times.windows(2).map(|pair| pair[1] - pair[0]).collect();
                sorted.sort_unstable_by(f64::total_cmp);
                let intervals = Intervals { sorted };
                match intervals.median() > STREAM_S {
                    true => Err(UndefinedReason::NoStream),
                    false => Ok(intervals),
                }
            }
        }
    }

    /// Median interval between frames, s: the middle interval, or the mean of the two middle intervals.
    fn median(&self) -> f64 {
        let middle = self.sorted.len() / 2;
        if self.sorted.len() % 2 == 1 {
            self.sorted[middle]
        } else {
            self.sorted[middle - 1] * 0.5 + self.sorted[middle] * 0.5
        }
    }

    /// Frame rate, Hz: the reciprocal of the median interval.
    pub(super) fn frame_rate(&self) -> Finished {
        Ok(1.0 / self.median())
    }

    /// Sample standard deviation of the intervals without gaps, s.
    pub(super) fn jitter(&self) -> Finished {
        let regular: Moments = self.regular().iter().copied().collect();
        regular
            .deviation(1)
            .ok_or(UndefinedReason::TooFew { least: 3 })
    }

    /// Share of intervals that are gaps, longer than 1.5 medians.
    pub(super) fn dropped(&self) -> f64 {
        let count = |intervals: &[f64]| intervals.iter().fold(0_u64, |count, _| count + 1);
        let all = count(&self.sorted);
        let gaps = all - count(self.regular());
        Dyadic::from(gaps).over(&Dyadic::from(all))
    }

    /// Intervals that are not gaps: at most 1.5 medians.
    fn regular(&self) -> &[f64] {
        let limit = GAP * self.median();
        let regular = self.sorted.partition_point(|interval| *interval <= limit);
        &self.sorted[..regular]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sums(times_s: &[f64]) -> IntrinsicSums {
        let mut sums = IntrinsicSums::default();
        times_s.iter().for_each(|time| sums.add_time(*time, None));
        sums
    }

    #[test]
    fn a_steady_camera_that_lost_two_frames_keeps_its_rate() {
        let frames = (0..40).filter(|frame| ![7, 23].contains(frame));
        let times: Vec<f64> = frames.map(|frame| f64::from(frame) * 0.03125).collect();
        let intervals = Intervals::of(&sums(&times)).expect("many times");
        assert_eq!(intervals.frame_rate(), Ok(32.0));
        assert_eq!(intervals.jitter(), Ok(0.0));
        assert_eq!(intervals.dropped().to_bits(), (2.0_f64 / 37.0).to_bits());
    }

    #[test]
    fn one_press_every_few_seconds_is_no_stream() {
        let presses: Vec<f64> = (0..40).map(|press| f64::from(press) * 4.375).collect();
        let reason = Intervals::of(&sums(&presses)).err();
        assert_eq!(reason, Some(UndefinedReason::NoStream));
        assert!(
            Intervals::of(&sums(&[0.0, 1.0, 2.0])).is_ok(),
            "1 Hz is a stream"
        );
    }

    #[test]
    fn a_hand_calculation_of_rate_and_jitter() {
        // Intervals 0.25, 0.5, 0.25, 0.5: median 0.375, all within 0.5625; variance 0.25² / 4 × 4 / 3.
        let intervals = Intervals::of(&sums(&[0.0, 0.25, 0.75, 1.0, 1.5])).expect("times");
        assert_eq!(intervals.frame_rate(), Ok(1.0 / 0.375));
        assert_eq!(intervals.jitter(), Ok((0.0625_f64 / 3.0).sqrt()));
    }

    #[test]
    fn without_two_times_there_is_no_interval_and_the_reason_says_which_it_is() {
        let reason = |sums: &IntrinsicSums| Intervals::of(sums).err();
        assert_eq!(reason(&sums(&[])), Some(UndefinedReason::NoTimes));
        assert_eq!(
            reason(&sums(&[1.0])),
            Some(UndefinedReason::TooFew { least: 2 })
        );
        assert_eq!(
            reason(&sums(&[1.0, 1.0])),
            Some(UndefinedReason::EqualTimes)
        );
    }
}
