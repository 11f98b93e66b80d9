//! Context in which presses are made: drivers, clock, changer of specimens, operator and viewer.

use std::sync::{Arc, Mutex};
use std::time::Duration;

use taceva_core::{Progress, Rig, SimulatedBench};
use taceva_drivers::{Drivers, MonotonicClock, Selector};
use taceva_protocol::{ContentId, Operator, SpecimenChanger, Timekeeper};

use crate::viewer::Viewer;

/// Clock, gel and specimen changer of a rig.
pub struct Surroundings {
    /// Clock that stamps the samples of the devices.
    pub clock: Box<dyn Timekeeper>,
    /// Changer of specimens; `None` if the operator or nobody changes specimens.
    pub specimens: Option<Box<dyn SpecimenChanger>>,
    /// Callback for each press, called before the tip moves to the place of the press; `None` for no callback.
    pub upcoming: Option<Box<dyn FnMut(Upcoming)>>,
    /// Name of the gel in the recording; `None` if unknown.
    pub gel: Option<String>,
    /// Simulated bench of the rig; `None` for other rigs. Its clock also stamps the frames of a sensor that belongs to another bench.
    pub bench: Option<Arc<dyn SimulatedBench>>,
    /// True if a simulated gel restarts as new in every process, and wears with each press.
    ///
    /// On such a rig, an interrupted run repeats the recorded presses at a place when it resumes. The run compares these presses with the recording,
    /// and does not record them twice.
    pub begins_anew: bool,
}

impl Surroundings {
    /// Surroundings of a real rig. Its clock is the monotonic clock of the machine, and its gel is not new in each process.
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

/// Monotonic clock of the machine.
struct MachineTime;

impl Timekeeper for MachineTime {
    fn now_s(&self) -> f64 {
        MonotonicClock.now_s()
    }

    fn rest(&mut self, rest: Duration) {
        std::thread::sleep(rest);
    }
}

/// The next press.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Upcoming {
    /// Id of the press.
    pub press: ContentId,
    /// Planned start of the press, on the clock of the rig. If the clock can be set, an interrupted and resumed run has the same start times.
    pub begins: Duration,
}

/// Callback that returns the surroundings of a simulated rig from the selector of its robot; `None` if the clock of the robot is unknown. A real robot has
/// [`Surroundings::real`].
pub type SurroundingsOf<'a> = &'a (dyn Fn(&Selector, &mut Rig) -> Option<Surroundings> + Sync);

/// Context in which presses are made.
#[derive(Clone, Copy)]
pub struct Workshop<'a> {
    /// Drivers of the program.
    pub drivers: &'a Drivers,
    /// Surroundings of simulated rigs.
    pub surroundings: SurroundingsOf<'a>,
    /// Observer that receives progress, and can cancel the run.
    pub progress: &'a dyn Progress,
    /// Operator for manual steps on a real rig. If `None`, a scene that needs an operator is rejected before any device is opened.
    pub operator: Option<&'a Mutex<dyn Operator + Send>>,
    /// Viewer, if any. It receives frames and presses of a simulated bench, and also force and tip pose of a real rig.
    pub viewer: Option<&'a Arc<dyn Viewer>>,
}
