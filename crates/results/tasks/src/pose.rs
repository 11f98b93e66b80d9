//! Poses and changes of pose: errors of translation and rotation, shares of right bins, distances of an object's points.
//!
//! ```
//! use taceva_tasks::pose::{Pose, PoseState, PoseTask, Rotation};
//! let mut state = PoseState::new(PoseTask::default());
//! let turned = Rotation::of_quaternion(1, [0.0, 0.0, 0.6, 0.8])?;
//! let truth = Pose::new(1, [0.0, 0.0, 1.0], Rotation::IDENTITY)?;
//! state.push("trajectory 1", &truth, &Pose::new(1, [0.0, 0.0, 1.5], turned)?);
//! let scores = state.scores();
//! let translation = scores.iter().find(|score| score.metric == "pose_translation").ok_or("a score")?;
//! assert_eq!(translation.estimate.value, Ok(0.5));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod cloud;
mod error;
mod euler;
mod rigid;
mod rotation;
mod scores;
mod state;
mod thresholds;

pub use error::PoseError;
pub use euler::EulerErrors;
pub use rigid::Pose;
pub use rotation::Rotation;
pub use state::{PoseState, PoseTask};
pub use thresholds::Thresholds;
