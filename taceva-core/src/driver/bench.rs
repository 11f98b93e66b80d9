//! What a simulated bench has besides its devices: a virtual clock, and the exchange of specimens.

use std::time::Duration;

use super::DriverError;
use crate::specimen::Specimen;

/// A simulated bench, as the code that carries out a run uses it; found in a [`Rig`](crate::Rig) under the name that its devices were opened
/// with.
///
/// ```
/// use std::sync::{Arc, Mutex};
/// use std::time::Duration;
/// use taceva_core::{DriverError, Rig, SimulatedBench, Specimen};
///
/// /// A clock and nothing else.
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
    /// The time of its clock: that of every stamp of its devices.
    fn now(&self) -> Duration;

    /// Lets time pass.
    ///
    /// # Errors
    /// [`DriverError`] of kind `Disconnected` if the bench is gone.
    fn rest(&self, rest: Duration) -> Result<(), DriverError>;

    /// Exchanges what the robot carries.
    ///
    /// # Errors
    /// [`DriverError`] of kind `InvalidArgument` for a specimen that it does not have, or while the tip is in the gel.
    fn mount(&self, specimen: Specimen) -> Result<(), DriverError>;

    /// Gives the press that begins now the number `name`: every random number in it is a function of this and of the place, so that a run
    /// that was interrupted and resumed has the same random errors as one without interruption.
    ///
    /// # Errors
    /// As [`rest`](SimulatedBench::rest).
    fn name_press(&self, name: u64) -> Result<(), DriverError>;

    /// Lets the next tare in the air wait until `at` on the bench's clock, unless it is later already.
    ///
    /// # Errors
    /// As [`rest`](SimulatedBench::rest).
    fn schedule(&self, at: Duration) -> Result<(), DriverError>;

    /// What it is a model of: version, parameters and seed; `None` before a sensor was opened in it.
    fn provenance(&self) -> Option<String>;
}
