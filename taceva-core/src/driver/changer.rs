//! What brings things into place.

use std::sync::Arc;

use super::{Deadline, DriverError, Interrupt};

/// Brings one of the things that it holds into place: specimens under the robot (a tool changer, a carousel) or units of a sensor (a
/// revolver, a slide).
///
/// Things have names. Those of specimens are what [`Specimen`](crate::Specimen) displays, such as `sphere of radius 4 mm` or `line grating
/// of 1.5 mm`; those of units are what a scene calls them. Light is set by a [`Lighting`](super::Lighting), which has names in the same way.
///
/// The robot is halted away from the gel while a changer moves, and moves again only after it has said that what was asked for is in place.
///
/// ```
/// use taceva_core::{Changer, Deadline, DriverError, DriverKey, ErrorKind};
///
/// struct Carousel {
///     holds: Vec<String>,
///     /// The place that stands under the tip.
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
///         // What its own switch sees there, which may be another.
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
    /// The names of what it holds, each once.
    fn holds(&self) -> &[String];

    /// Brings what is called `name` into place, and gives the name of what is in place once nothing of the changer moves any more: what its
    /// own signals say, where it has such, and `name` where it has none. Where that is in place already, it need not move.
    ///
    /// After an error nobody knows what is in place; the changer stands, or comes to stand by itself.
    ///
    /// # Errors
    /// [`DriverError`] of kind `InvalidArgument` for a name that is not in [`holds`](Changer::holds), `Timeout` where it did not arrive in
    /// time, `Interrupted`, or what went wrong.
    fn bring(&mut self, name: &str, deadline: Deadline) -> Result<String, DriverError>;

    /// What ends a call under way and lets the changer stand, from any thread; `None` of one whose calls never wait.
    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        None
    }
}
