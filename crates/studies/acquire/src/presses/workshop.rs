//! What presses are made with, beside the devices themselves: drivers, clocks and whoever exchanges specimens.

use std::sync::{Arc, Mutex};
use std::time::Duration;

use taceva_core::{Progress, Rig, SimulatedBench};
use taceva_drivers::{Drivers, MonotonicClock, Selector};
use taceva_protocol::{ContentId, Operator, SpecimenChanger, Timekeeper};

use crate::viewer::Viewer;

/// What a rig has beside its devices.
pub struct Surroundings {
    /// The clock that the stamps of its devices are of.
    pub clock: Box<dyn Timekeeper>,
    /// Who exchanges what the robot carries; without one a single specimen serves every press.
    pub specimens: Option<Box<dyn SpecimenChanger>>,
    /// Is called with each press before the tip moves there.
    pub upcoming: Option<Box<dyn FnMut(Upcoming)>>,
    /// What the recording calls the gel.
    pub gel: Option<String>,
    /// The simulated bench, where the rig is one. A sensor that belongs to another bench is stamped by the clock of this one.
    pub bench: Option<Arc<dyn SimulatedBench>>,
    /// Whether its gel is new in every process, and remembers within one what was done to it.
    ///
    /// Such a rig goes on after an interruption only where the past of a place is done again first: recorded presses there are made
    /// once more, compared with what was recorded, and not recorded twice.
    pub begins_anew: bool,
}

impl Surroundings {
    /// Those of a real rig: the monotonic clock of the machine, which cannot be set, and a gel that keeps what was done to it.
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

/// Time that passes by itself.
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
    /// Its name.
    pub press: ContentId,
    /// When it begins by the clock of the rig, on a schedule that leaves every press ample time: a rig whose clock can be set then gives a press
    /// the same times whether the run was interrupted or not.
    pub begins: Duration,
}

/// Gives the surroundings of the rig whose simulated robot was opened by a selector; `None` where nobody knows its clock. Those of a real
/// robot are [`Surroundings::real`].
pub type SurroundingsOf<'a> = &'a (dyn Fn(&Selector, &mut Rig) -> Option<Surroundings> + Sync);

/// What presses are made with.
#[derive(Clone, Copy)]
pub struct Workshop<'a> {
    /// The drivers of the program.
    pub drivers: &'a Drivers,
    /// What rigs have beside their devices.
    pub surroundings: SurroundingsOf<'a>,
    /// Receives progress, and may cancel.
    pub progress: &'a dyn Progress,
    /// Who is asked for what no device of a real rig can do; without one a scene that needs hands is refused before anything is opened.
    pub operator: Option<&'a Mutex<dyn Operator + Send>>,
    /// Who looks on, if anybody: of a simulated bench at its frames and its presses, of a real rig at its force and its tip too.
    pub viewer: Option<&'a Arc<dyn Viewer>>,
}
