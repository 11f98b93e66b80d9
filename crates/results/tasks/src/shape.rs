//! Shapes as clouds of points: Chamfer distances and F scores.
//!
//! Publications call several distances Chamfer. Each point has a distance to the nearest point of the other cloud. The score is half the
//! sum of the mean distances of both clouds. The variant `sum` is the whole sum, and `squared` the sum of both means of squared distances.
//!
//! ```
//! use taceva_tasks::shape::{ShapeState, ShapeTask};
//! let mut state = ShapeState::new(ShapeTask::default().with_tau_mm(0.5)?);
//! state.push("object 1", 1, &[[0.0, 0.0, 0.0]], &[[0.0, 0.0, 0.25], [0.0, 0.0, 1.0]])?;
//! let scores = state.scores();
//! // 0.25 mm one way, the mean of 0.25 mm and 1 mm the other way.
//! assert_eq!(scores[0].estimate.value, Ok((0.25 + 0.625) / 2.0));
//! # Ok::<(), taceva_tasks::shape::ShapeError>(())
//! ```

mod distances;
mod error;
mod state;

pub use error::ShapeError;
pub use state::{ShapeState, ShapeTask};
