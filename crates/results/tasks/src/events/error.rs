//! Errors of frames and rules of events.

/// Reason why a frame or a rule of events is refused.
///
/// ```
/// use taceva_tasks::events::{EventRule, EventState, Frame};
/// let frames = [Frame::new(7, Some(1.5), false, 0.0), Frame::new(8, Some(1.25), false, 0.0)];
/// let refused = EventState::new(EventRule::default()).push("stroke 1", &frames);
/// let text = "row 8: time 1.25 s is before 1.5 s of row 7, expected times that do not go back; sort the rows by time";
/// assert_eq!(refused.map_err(|error| error.to_string()), Err(text.to_owned()));
/// ```
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum EventError {
    /// A score that is not finite.
    #[error("row {row}: the score is {value}, expected a finite number")]
    Score {
        /// Row of the frame.
        row: u64,
        /// Score found.
        value: f64,
    },
    /// A time that is not finite, or too great.
    #[error("row {row}: the time is {value}, expected a number from -1e12 to 1e12 s")]
    Time {
        /// Row of the frame.
        row: u64,
        /// Time found, s.
        value: f64,
    },
    /// A frame without a time in a sequence with times.
    #[error("row {row}: no time, expected a time as in the other rows of the sequence")]
    NoTime {
        /// Row of the frame.
        row: u64,
    },
    /// A time earlier than the time of the frame before.
    #[error(
        "row {row}: time {time_s} s is before {before_s} s of row {before_row}, expected times that do not go back; sort the rows by time"
    )]
    TimeGoesBack {
        /// Row of the frame with the earlier time.
        row: u64,
        /// Time of the frame in `row`, s.
        time_s: f64,
        /// Row of the frame before.
        before_row: u64,
        /// Time of the frame before, s.
        before_s: f64,
    },
    /// A threshold that is not finite.
    #[error("the threshold is {0}, expected a finite number")]
    Threshold(f64),
    /// A debounce of 0 frames.
    #[error("debounce is 0, expected 1 frame or more")]
    Debounce,
    /// A tolerance that is not a valid time, s.
    #[error("the tolerance is {0} s, expected a number from 0 to 1e6 s")]
    Tolerance(f64),
}
