//! Frames of a sequence.

use super::error::EventError;

/// Greatest magnitude of a time, s.
const GREATEST_S: f64 = 1e12;

/// Frame of a sequence, with its true label and a predicted score of an event such as slip.
///
/// ```
/// use taceva_tasks::events::Frame;
/// let frame = Frame::new(1, Some(0.04), true, 0.8);
/// assert_eq!((frame.row, frame.truth), (1, true));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Frame {
    /// Row of the frame, for messages.
    pub row: u64,
    /// Time in s; `None` if times are unknown.
    pub time_s: Option<f64>,
    /// True during the event.
    pub truth: bool,
    /// Score of the event: any real number, or 0 and 1.
    pub score: f64,
}

impl Frame {
    /// Frame of row `row`.
    #[must_use]
    pub fn new(row: u64, time_s: Option<f64>, truth: bool, score: f64) -> Frame {
        Frame {
            row,
            time_s,
            truth,
            score,
        }
    }
}

/// Checks the frames of a sequence, and returns their times; `None` if no frame has a time.
pub(super) fn checked_times(frames: &[Frame]) -> Result<Option<Vec<f64>>, EventError> {
    for &Frame { row, score, .. } in frames {
        if !score.is_finite() {
            return Err(EventError::Score { row, value: score });
        }
    }
    if frames.iter().all(|frame| frame.time_s.is_none()) {
        return Ok(None);
    }
    let mut times = Vec::with_capacity(frames.len());
    let mut before: Option<(u64, f64)> = None;
    for &Frame { row, time_s, .. } in frames {
        let time_s = time_s.ok_or(EventError::NoTime { row })?;
        if !(-GREATEST_S..=GREATEST_S).contains(&time_s) {
            return Err(EventError::Time { row, value: time_s });
        }
        if let Some((before_row, before_s)) = before.filter(|(_, before_s)| *before_s > time_s) {
            return Err(EventError::TimeGoesBack {
                row,
                time_s,
                before_row,
                before_s,
            });
        }
        before = Some((row, time_s));
        times.push(time_s);
    }
    Ok(Some(times))
}
