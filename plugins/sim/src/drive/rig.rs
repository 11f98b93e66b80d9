//! The bench that devices share, for whoever conducts a run on it.

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
    /// The simulated rig called `name` among the devices of `rig`, made if there is none and offered there as the bench `sim <name>`.
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

    /// The time of the rig's clock: that of every stamp of its devices.
    pub fn now(&self) -> Duration {
        self.state().now()
    }

    /// Lets time pass.
    pub fn rest(&self, rest: Duration) {
        self.state().rest(rest);
    }

    /// Exchanges what the robot carries.
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

    /// Calls the press that begins now by `name`: from the next tare in the air on, all that is random in it is a function of the name and
    /// the place. So a run that was interrupted and resumed meets the errors it would have met anyway.
    ///
    /// Without names, visits to a place are counted.
    pub fn name_press(&self, name: u64) {
        self.state().name_visits(name);
    }

    /// Lets the next tare in the air wait until `at` on the rig's clock, unless it is later already: with a schedule of its own, a run that
    /// was interrupted and resumed takes place at the hour at which it would have taken place anyway.
    pub fn schedule(&self, at: Duration) {
        self.state().schedule(at);
    }

    /// Notes a press that an earlier session finished, for gels that are conditioned by use.
    pub fn remember(&self, place_mm: [f64; 2], deepest_mm: f64) {
        self.state().remember(place_mm, deepest_mm);
    }

    /// What it says of itself; `None` before a sensor was opened in it.
    pub fn provenance(&self) -> Option<Provenance> {
        let state = self.state();
        state.bench.as_ref().map(|bench| bench.provenance())
    }

    /// The contact of a ball, as it truly is now; `None` under a board, or before a sensor was opened.
    pub fn truth(&self) -> Option<Contact> {
        self.state().contact()
    }

    /// The state, whole whatever happened to another thread: every change of it is finished before it can be interrupted.
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
