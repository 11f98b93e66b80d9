//! Public handle of a simulated rig.

use std::fmt;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use taceva_core::{DriverError, ErrorKind, Rig, SimulatedBench, Specimen};

use super::error::{ROBOT, failed};
use super::specimen::{MountError, Mounted};
use super::state::State;
use crate::contact::Contact;
use crate::provenance::{MODEL_VERSION, Provenance};

/// A simulated rig: the clock and the gel that its devices share.
///
/// ```
/// use taceva_core::{Nanometre, Rig};
/// use taceva_sim::{Mounted, SimulatedRig};
/// let bench = SimulatedRig::of(&mut Rig::new(), "bench");
/// bench.mount(Mounted::ball(Nanometre(10_000_000))?)?;
/// let hour = std::time::Duration::from_secs(3600);
/// bench.rest(hour);
/// assert_eq!(bench.now(), hour);
/// # Ok::<(), taceva_sim::MountError>(())
/// ```
#[derive(Clone)]
pub struct SimulatedRig {
    state: Arc<Mutex<State>>,
}

impl SimulatedRig {
    /// Gets or creates the simulated rig `name` of `rig`, and registers it as the bench `sim <name>`.
    pub fn of(rig: &mut Rig, name: &str) -> SimulatedRig {
        let state = rig
            .share(&format!("taceva-sim {name}"), || {
                Ok(Mutex::new(State::new()))
            })
            .expect("making a state does not fail");
        let bench = SimulatedRig { state };
        rig.offer_bench(&format!("sim {name}"), Arc::new(bench.clone()));
        bench
    }

    /// Time of the rig's clock. The stamps of its devices use this clock.
    pub fn now(&self) -> Duration {
        self.state().now()
    }

    /// Advances the clock by `rest`.
    pub fn rest(&self, rest: Duration) {
        self.state().rest(rest);
    }

    /// Changes the specimen on the robot.
    ///
    /// # Errors
    /// [`MountError::InContact`] while the tip is in the gel.
    pub fn mount(&self, specimen: Mounted) -> Result<(), MountError> {
        let mut state = self.state();
        if state.is_touching() {
            return Err(MountError::InContact);
        }
        state.release();
        state.mounted = specimen;
        Ok(())
    }

    /// Names the next press. From the next tare in the air on, all its random numbers depend only on the name and the place. A resumed run therefore has the
    /// same errors.
    ///
    /// Without a name, the numbers depend on the count of visits to the place.
    pub fn name_press(&self, name: u64) {
        self.state().name_visits(name);
    }

    /// Delays the next tare in the air until `at` on the rig's clock, unless that time has passed. A resumed run with a schedule therefore takes
    /// place at the original times.
    pub fn schedule(&self, at: Duration) {
        self.state().schedule(at);
    }

    /// Adds a press of an earlier session, for gels that are conditioned by use.
    pub fn remember(&self, place_mm: [f64; 2], deepest_mm: f64) {
        self.state().remember(place_mm, deepest_mm);
    }

    /// Provenance of the bench; `None` before a sensor or gel is installed.
    pub fn provenance(&self) -> Option<Provenance> {
        let state = self.state();
        state.bench.as_ref().map(|bench| bench.provenance())
    }

    /// True present contact of a ball; `None` under a board or without a gel.
    pub fn truth(&self) -> Option<Contact> {
        self.state().contact()
    }

    /// Locks the state. Ignores poisoning, because every change completes before any panic is possible.
    pub(super) fn state(&self) -> MutexGuard<'_, State> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl SimulatedBench for SimulatedRig {
    fn now(&self) -> Duration {
        SimulatedRig::now(self)
    }

    fn rest(&self, rest: Duration) -> Result<(), DriverError> {
        SimulatedRig::rest(self, rest);
        Ok(())
    }

    fn mount(&self, specimen: Specimen) -> Result<(), DriverError> {
        let mounted = match specimen {
            Specimen::Sphere { radius } => Mounted::ball(radius),
            Specimen::Grating { kind, spacing } => Mounted::board(kind, spacing),
        };
        mounted
            .and_then(|mounted| SimulatedRig::mount(self, mounted))
            .map_err(|error| {
                failed(
                    ErrorKind::InvalidArgument,
                    &ROBOT,
                    "mount a specimen",
                    error,
                )
            })
    }

    fn name_press(&self, name: u64) -> Result<(), DriverError> {
        SimulatedRig::name_press(self, name);
        Ok(())
    }

    fn schedule(&self, at: Duration) -> Result<(), DriverError> {
        SimulatedRig::schedule(self, at);
        Ok(())
    }

    fn provenance(&self) -> Option<String> {
        let provenance = SimulatedRig::provenance(self)?;
        Some(format!(
            "bench {MODEL_VERSION}, parameters {}, seed {}",
            provenance.parameters, provenance.seed
        ))
    }
}

impl fmt::Debug for SimulatedRig {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SimulatedRig")
            .field("now", &self.now())
            .finish_non_exhaustive()
    }
}
