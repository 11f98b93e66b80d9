//! Due times of the frames of a recording, including its repetitions.

/// Due times of the frames of a recording, with a shift. A repeated recording is replayed in rounds, and the frame numbers continue across rounds.
#[derive(Debug)]
pub(super) struct Timeline {
    /// Times of the frames of one round, s: at least one time, strictly increasing.
    times_s: Vec<f64>,
    repeat: bool,
    shift_s: f64,
}

impl Timeline {
    pub(super) fn new(times_s: Vec<f64>, repeat: bool) -> Timeline {
        Timeline {
            times_s,
            repeat,
            shift_s: 0.0,
        }
    }

    /// Delays all frames by `by_s`, s.
    pub(super) fn shift(&mut self, by_s: f64) {
        self.shift_s += by_s;
    }

    /// Position in the recording, from 0, of the frame with number `frame` over all rounds.
    pub(super) fn position(&self, frame: usize) -> usize {
        frame % self.times_s.len()
    }

    /// Due time of frame number `frame`, s; `None` after the end.
    pub(super) fn time_s(&self, frame: usize) -> Option<f64> {
        let round = frame / self.times_s.len();
        #[expect(
            clippy::cast_precision_loss,
            reason = "a replay never reaches 2^53 rounds"
        )]
        let begins_s = self.shift_s + round as f64 * self.round_s();
        (self.repeat || round == 0).then(|| begins_s + self.times_s[self.position(frame)])
    }

    /// Number of the newest frame that is due at `now_s`; the first frame if no frame is due.
    pub(super) fn newest(&self, now_s: f64) -> usize {
        let frames = self.times_s.len();
        let elapsed_s = now_s - self.shift_s - self.times_s[0];
        let round = match self.repeat {
            true => (elapsed_s / self.round_s()).floor().max(0.0),
            false => 0.0,
        };
        let in_round_s = self.times_s[0] + (elapsed_s - round * self.round_s());
        let come = self.times_s.partition_point(|time_s| *time_s <= in_round_s);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "not negative, and the cast saturates"
        )]
        let rounds = round as usize;
        rounds
            .saturating_mul(frames)
            .saturating_add(come.saturating_sub(1))
    }

    /// Duration of one round through the recording, s. The last frame lasts as long as the previous frame; a single frame lasts 1 s.
    fn round_s(&self) -> f64 {
        match self.times_s.as_slice() {
            [first, .., before, last] => (last - first) + (last - before),
            [first, last] => 2.0 * (last - first),
            _ => 1.0,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_recording_that_repeats_goes_on_at_its_own_rate() {
        let timeline = Timeline::new(vec![10.0, 10.5, 11.0], true);
        let times: Vec<_> = (0..7).map(|frame| timeline.time_s(frame)).collect();
        let expected = [10.0, 10.5, 11.0, 11.5, 12.0, 12.5, 13.0];
        assert_eq!(times, expected.map(Some));
        assert_eq!((timeline.position(4), timeline.position(6)), (1, 0));
        for (now_s, newest) in [
            (9.0, 0),
            (10.4, 0),
            (10.5, 1),
            (11.4, 2),
            (11.5, 3),
            (13.2, 6),
        ] {
            assert_eq!(timeline.newest(now_s), newest, "{now_s}");
        }
    }

    #[test]
    fn a_recording_that_ends_has_no_frame_after_its_last() {
        let mut timeline = Timeline::new(vec![0.0, 1.0], false);
        timeline.shift(5.0);
        assert_eq!(timeline.time_s(1), Some(6.0));
        assert_eq!(timeline.time_s(2), None);
        assert_eq!(timeline.newest(1e9), 1);
        assert_eq!(timeline.newest(f64::NEG_INFINITY), 0);
    }

    #[test]
    fn two_frames_and_one_frame_have_a_length_too() {
        let pair = Timeline::new(vec![1.0, 1.25], true);
        assert_eq!(pair.time_s(2), Some(1.5));
        let single = Timeline::new(vec![3.0], true);
        assert_eq!(single.time_s(4), Some(7.0));
    }
}
