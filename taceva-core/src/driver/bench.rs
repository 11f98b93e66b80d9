//! Interface of a simulated bench: its virtual clock, and the exchange of specimens.

use std::time::Duration;

use super::DriverError;
use crate::specimen::Specimen;

/// Simulated bench that several devices share. A [`Rig`](crate::Rig) stores the bench under the name with which its devices were opened.
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
    /// Time of the bench's clock, which stamps every reading of its devices.
    fn now(&self) -> Duration;

    /// Advances the clock of the bench by `rest`.
    ///
    /// # Errors
    /// [`DriverError`] of kind `Disconnected` if the bench no longer exists.
    fn rest(&self, rest: Duration) -> Result<(), DriverError>;

    /// Mounts another specimen on the robot.
    ///
    /// # Errors
    /// [`DriverError`] of kind `InvalidArgument` for a specimen that the bench lacks, or while the tip is in the gel.
    fn mount(&self, specimen: Specimen) -> Result<(), DriverError>;

    /// Sets the number `name` of the press that begins now. Every random number of a press is a function of this number and the place. A
    /// resumed run therefore has the same random errors as an uninterrupted run.
    ///
    /// # Errors
    /// The errors of [`rest`](SimulatedBench::rest).
    fn name_press(&self, name: u64) -> Result<(), DriverError>;

    /// Delays the next tare in the air until the time `at` on the bench's clock. A time in the past causes no delay.
    ///
    /// # Errors
    /// The errors of [`rest`](SimulatedBench::rest).
    fn schedule(&self, at: Duration) -> Result<(), DriverError>;

    /// Provenance of the simulation: version, parameters and seed; `None` until a sensor of the bench is opened.
    fn provenance(&self) -> Option<String>;
}
