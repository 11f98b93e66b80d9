//! The light around a sensor.

use super::{Deadline, DriverError};

/// External light on a sensor. Its settings are called scenes and have names, such as `dark`.
///
/// Arguments of the sensor set the light inside the sensor.
///
/// ```
/// use taceva_core::{Deadline, DriverError, DriverKey, ErrorKind, Lighting};
///
/// struct Lamps {
///     scenes: Vec<String>,
///     lit: usize,
/// }
///
/// impl Lighting for Lamps {
///     fn scenes(&self) -> &[String] {
///         &self.scenes
///     }
///     fn set(&mut self, scene: &str, _: Deadline) -> Result<(), DriverError> {
///         let unknown = || {
///             let lamps = DriverKey::fixed("room/lamps");
///             DriverError::new(ErrorKind::InvalidArgument, &lamps, "set a scene")
///         };
///         let found = self.scenes.iter().position(|known| known == scene);
///         self.lit = found.ok_or_else(unknown)?;
///         Ok(())
///     }
/// }
///
/// let mut lamps = Lamps { scenes: vec!["dark".to_owned(), "bright".to_owned()], lit: 0 };
/// lamps.set("bright", Deadline::PASSED)?;
/// assert_eq!(lamps.lit, 1);
/// assert!(lamps.set("dusk", Deadline::PASSED).is_err());
/// # Ok::<(), DriverError>(())
/// ```
pub trait Lighting: Send {
    /// Names of the scenes. By default, a run sets them in this order and calibrates the sensor in the first scene.
    fn scenes(&self) -> &[String];

    /// Sets the scene called `scene` and returns once the light is steady.
    ///
    /// # Errors
    /// [`DriverError`] of kind `InvalidArgument` for a scene that is not in [`scenes`](Lighting::scenes), or `Timeout`.
    fn set(&mut self, scene: &str, deadline: Deadline) -> Result<(), DriverError>;
}
