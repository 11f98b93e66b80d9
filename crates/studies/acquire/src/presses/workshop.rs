//! Environment of presses beside the devices: drivers, clocks and changers of specimens.

use std::sync::{Arc, Mutex};
use std::time::Duration;

use taceva_core::{Progress, Rig, SimulatedBench};
use taceva_drivers::{Drivers, MonotonicClock, Selector};
use taceva_protocol::{ContentId, Operator, SpecimenChanger, Timekeeper};

use crate::viewer::Viewer;

/// Parts of a rig beside its devices.
pub struct Surroundings {
    /// Clock of the stamps of its devices.
    pub clock: Box<dyn Timekeeper>,
    /// Changer of specimens; with `None`, a single specimen serves every press.
    pub specimens: Option<Box<dyn SpecimenChanger>>,
    /// Callback for each press before the tip moves there.
    pub upcoming: Option<Box<dyn FnMut(Upcoming)>>,
    /// Name of the gel in the recording.
    pub gel: Option<String>,
    /// Simulated bench, if the rig is one. Its clock stamps a sensor of another bench.
    pub bench: Option<Arc<dyn SimulatedBench>>,
    /// True if its gel is new in every process, and has a history within one.
    ///
    /// After an interruption, such a rig first restores the history of a place: it repeats the recorded presses there, compares them with
    /// the recording, and does not record them twice.
    pub begins_anew: bool,
}

impl Surroundings {
    /// Surroundings of a real rig: the monotonic clock of the machine, which cannot be set, and a gel with a lasting history.
    pub fn real() -> Surroundings {
        Surroundings {
            clock: Box::new(MachineTime),
            specimens: None,
            upcoming: None,
            gel: None,
            bench: None,
            begins_anew: false,
        }
    }
}

/// The real-time clock of the machine.
struct MachineTime;

impl Timekeeper for MachineTime {
    fn now_s(&self) -> f64 {
        MonotonicClock.now_s()
    }

    fn rest(&mut self, rest: Duration) {
        std::thread::sleep(rest);
    }
}

/// A press that is about to be made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Upcoming {
    /// Id of the press.
    pub press: ContentId,
    /// Start on the clock of the rig, by a schedule with ample time for every press. A rig with a settable clock then gives a press the
    /// same times with and without interruption.
    pub begins: Duration,
}

/// Callback that returns the surroundings of the rig whose simulated robot a selector opened; `None` if its clock is unknown. A real robot
/// has [`Surroundings::real`].
pub type SurroundingsOf<'a> = &'a (dyn Fn(&Selector, &mut Rig) -> Option<Surroundings> + Sync);

/// Environment of presses.
#[derive(Clone, Copy)]
pub struct Workshop<'a> {
    /// The drivers of the program.
    pub drivers: &'a Drivers,
    /// Surroundings of simulated rigs.
    pub surroundings: SurroundingsOf<'a>,
    /// Receives progress, and may cancel.
    pub progress: &'a dyn Progress,
    /// Operator for manual steps on a real rig; with `None`, a scene that needs one is rejected before anything is opened.
    pub operator: Option<&'a Mutex<dyn Operator + Send>>,
    /// Viewer, if any: of frames and presses of a simulated bench, and of force and tip of a real rig too.
    pub viewer: Option<&'a Arc<dyn Viewer>>,
}
