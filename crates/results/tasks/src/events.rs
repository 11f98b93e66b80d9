//! Events in sequences of frames: onsets of slip or touch, their delays, false alarms.
//!
//! ```
//! use taceva_tasks::events::{EventRule, EventState, Frame};
//! let mut state = EventState::new(EventRule::default().with_threshold(0.4)?);
//! let frames = [(0.0, false, 0.1), (0.1, true, 0.3), (0.2, true, 0.9)];
//! let frames: Vec<Frame> = (1..).zip(frames).map(|(row, (time_s, truth, score))| Frame::new(row, Some(time_s), truth, score)).collect();
//! state.push("stroke 1", &frames)?;
//! let scores = state.scores();
//! let f1 = scores.iter().find(|score| score.metric == "onset_f1").ok_or("a score")?;
//! assert_eq!(f1.estimate.value, Ok(1.0));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod frame;
mod onsets;
mod rule;
mod scores;
mod state;

pub use error::EventError;
pub use frame::Frame;
pub use onsets::{OnsetPair, match_onsets};
pub use rule::EventRule;
pub use state::EventState;
