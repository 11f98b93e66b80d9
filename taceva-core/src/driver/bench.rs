//! Simulated bench without its devices: a virtual clock, and the exchange of specimens.

use std::time::Duration;

use super::DriverError;
use crate::specimen::Specimen;

/// Simulated bench, as the code of a run uses it. A [`Rig`](crate::Rig) holds it under the name with which its devices were opened.
///
/// ```
/// use std::sync::{Arc, Mutex};
/// use std::time::Duration;
/// use taceva_core::{DriverError, Rig, SimulatedBench, Specimen};
///
/// /// A bench with only a clock.
/// #[derive(Default)]
/// struct Clock(Mutex<Duration>);
///
/// impl SimulatedBench for Clock {
///     fn now(&self) -> Duration {
///         *self.0.lock().expect("nobody panics with it")
///     }
///     fn rest(&self, rest: Duration) -> Result<(), DriverError> {
///         *self.0.lock().expect("nobody panics with it") += rest;
///         Ok(())
///     }
///     fn mount(&self, _: Specimen) -> Result<(), DriverError> {
///         Ok(())
///     }
///     fn name_press(&self, _: u64) -> Result<(), DriverError> {
///         Ok(())
///     }
///     fn schedule(&self, _: Duration) -> Result<(), DriverError> {
///         Ok(())
///     }
///     fn provenance(&self) -> Option<String> {
///         None
///     }
/// }
///
/// let mut rig = Rig::new();
/// rig.offer_bench("sim bench", Arc::new(Clock::default()));
/// let bench = rig.bench("sim bench").expect("it was offered");
/// bench.rest(Duration::from_secs(3600))?;
/// assert_eq!(bench.now(), Duration::from_secs(3600));
/// # Ok::<(), DriverError>(())
/// ```
pub trait SimulatedBench: Send + Sync {
    /// Time of its clock, which stamps every reading of its devices.
    fn now(&self) -> Duration;

    /// Advances the clock of the bench by `rest`.
    ///
    /// # Errors
    /// [`DriverError`] of kind `Disconnected` if the bench is gone.
    fn rest(&self, rest: Duration) -> Result<(), DriverError>;

    /// Mounts another specimen on the robot.
    ///
    /// # Errors
    /// [`DriverError`] of kind `InvalidArgument` for a specimen that it does not have, or while the tip is in the gel.
    fn mount(&self, specimen: Specimen) -> Result<(), DriverError>;

    /// Sets the number `name` of the press that begins now. Every random number of a press is a function of this number and the place. A
    /// resumed run therefore has the same random errors as an uninterrupted one.
    ///
    /// # Errors
    /// As [`rest`](SimulatedBench::rest).
    fn name_press(&self, name: u64) -> Result<(), DriverError>;

    /// Delays the next tare in the air until `at` on the bench's clock, unless it is later already.
    ///
    /// # Errors
    /// As [`rest`](SimulatedBench::rest).
    fn schedule(&self, at: Duration) -> Result<(), DriverError>;

    /// Provenance of the simulation: version, parameters and seed; `None` until a sensor is opened in it.
    fn provenance(&self) -> Option<String>;
}
