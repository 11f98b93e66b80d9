//! The light around a sensor.

use super::{Deadline, DriverError};

/// Light that falls on a sensor from outside, in scenes that have a name.
///
/// The light inside a sensor belongs to the sensor and is set by its arguments.
pub trait Lighting: Send {
    /// The names of the scenes, in the order in which a sweep visits them; the first is the one in which a sensor is calibrated.
    fn scenes(&self) -> &[String];

    /// Sets the scene called `scene` and returns once the light is steady.
    ///
    /// # Errors
    /// [`DriverError`] of kind `InvalidArgument` for a scene that is not in [`scenes`](Lighting::scenes), or `Timeout`.
    fn set(&mut self, scene: &str, deadline: Deadline) -> Result<(), DriverError>;
}
