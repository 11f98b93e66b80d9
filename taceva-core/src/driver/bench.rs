//! Interface of a bench, which is a simulated rig: its virtual clock and the exchange of specimens.

use std::time::Duration;

use super::DriverError;
use crate::specimen::Specimen;

/// Simulated rig whose devices share one virtual clock. A [`Rig`](crate::Rig) stores each bench by its name, such as `sim bench`.
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
    /// [`DriverError`] of kind `InvalidArgument` for a specimen that the bench lacks, or while the mounted specimen touches the gel.
    fn mount(&self, specimen: Specimen) -> Result<(), DriverError>;

    /// Numbers the next press as `name`. The random errors of a press depend only on this number and its place on the gel. A resumed run
    /// therefore has the same random errors as an uninterrupted run.
    ///
    /// # Errors
    /// The errors of [`rest`](SimulatedBench::rest).
    fn name_press(&self, name: u64) -> Result<(), DriverError>;

    /// Delays the next tare out of contact until the bench's clock reads `at`. A time in the past causes no delay.
    ///
    /// # Errors
    /// The errors of [`rest`](SimulatedBench::rest).
    fn schedule(&self, at: Duration) -> Result<(), DriverError>;

    /// Provenance of the simulation: version, parameters and seed; `None` until a sensor of the bench is opened.
    fn provenance(&self) -> Option<String>;
}
