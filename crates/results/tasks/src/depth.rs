//! Depth maps of a contact: errors of depth, area of contact, directions of the surface.
//!
//! ```
//! use taceva_tasks::depth::{DepthMap, DepthState, DepthTask};
//! let mut state = DepthState::new(DepthTask::default());
//! let truth = DepthMap::new(1, 3, vec![0.0, 0.5, 1.0])?;
//! let prediction = DepthMap::new(1, 3, vec![0.0, 0.25, f64::NAN])?;
//! state.push("press 1", 1, &truth, &prediction)?;
//! let scores = state.scores();
//! let error = scores.iter().find(|score| score.metric == "depth_mae").ok_or("a score")?;
//! assert_eq!((error.estimate.value, error.estimate.n), (Ok(0.125), 2));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod error;
mod map;
mod normals;
mod pixels;
mod scores;
mod state;
mod task;

pub use error::DepthError;
pub use map::DepthMap;
pub use state::DepthState;
pub use task::DepthTask;
