//! Changers, which bring specimens or units of a sensor into place.

use std::sync::Arc;

use super::{Deadline, DriverError, Interrupt};

/// Device that moves one of its items into place: specimens under the robot (a tool changer, a carousel) or units of a sensor (a revolver, a slide).
///
/// Items have names. A specimen's name is its displayed text ([`Specimen`](crate::Specimen)), such as `sphere of radius 4 mm` or `line grating of
/// 1.5 mm`. A unit's name is its name in the scene file.
///
/// The robot is halted away from the gel while a changer moves. The robot moves again only after the changer has confirmed the requested
/// item.
///
/// ```
/// use taceva_core::{Changer, Deadline, DriverError, DriverKey, ErrorKind};
///
/// struct Carousel {
///     holds: Vec<String>,
///     /// Position of the item under the tip.
///     at: usize,
/// }
///
/// impl Changer for Carousel {
///     fn holds(&self) -> &[String] {
///         &self.holds
///     }
///     fn bring(&mut self, name: &str, _: Deadline) -> Result<String, DriverError> {
///         let unknown = || {
///             let carousel = DriverKey::fixed("lab/carousel");
///             DriverError::new(ErrorKind::InvalidArgument, &carousel, "bring a specimen")
///         };
///         let found = self.holds.iter().position(|known| known == name);
///         self.at = found.ok_or_else(unknown)?;
///         // Report the item that the device's own switch shows; it may differ from the requested one.
///         Ok(self.holds[self.at].clone())
///     }
/// }
///
/// let holds = vec!["sphere of radius 4 mm".to_owned(), "line grating of 1.5 mm".to_owned()];
/// let mut carousel = Carousel { holds, at: 0 };
/// assert_eq!(carousel.bring("line grating of 1.5 mm", Deadline::PASSED)?, "line grating of 1.5 mm");
/// assert!(carousel.bring("sphere of radius 1 mm", Deadline::PASSED).is_err());
/// # Ok::<(), DriverError>(())
/// ```
pub trait Changer: Send {
    /// Names of the changer's items, each once.
    fn holds(&self) -> &[String];

    /// Moves the item `name` into place, waits until the changer is at rest, and returns the name of the item in place. The sensors of the changer
    /// measure the returned name. A changer without sensors returns `name`. For an item already in place, the changer need not move.
    ///
    /// After an error the item in place is unknown, and the changer is at rest or stops by itself.
    ///
    /// # Errors
    /// [`DriverError`] of kind `InvalidArgument` for a name not in [`holds`](Changer::holds), `Timeout` if the item is not in place within
    /// `deadline`, or `Interrupted`. Other failures have other kinds.
    fn bring(&mut self, name: &str, deadline: Deadline) -> Result<String, DriverError>;

    /// Handle that interrupts a pending call and stops the changer, from any thread; `None` if calls of this changer never block.
    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        None
    }
}
