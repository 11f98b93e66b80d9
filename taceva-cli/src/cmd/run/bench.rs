//! Parts of the simulated bench besides its devices: a clock without real waiting times, and changes of specimens.

use std::sync::Arc;
use std::time::Duration;

use taceva_acquire::{Surroundings, Upcoming};
use taceva_core::{Deadline, DriverError, Rig, SimulatedBench, Specimen, Stamp};
use taceva_drivers::Selector;
use taceva_protocol::{ContentId, SpecimenChanger, Timekeeper};
use taceva_sim::{MODEL_VERSION, Model};

/// Clock and specimens of the simulated bench that the robot `robot` belongs to; `None` if that bench is unknown.
pub(in crate::cmd) fn surroundings(robot: &Selector, rig: &mut Rig) -> Option<Surroundings> {
    let bench = rig.bench(&robot.bench()?)?;
    let gel = bench.provenance();
    let [announced, shared] = [0; 2].map(|_| Arc::clone(&bench));
    Some(Surroundings {
        clock: Box::new(BenchClock(Arc::clone(&bench))),
        specimens: Some(Box::new(BenchClock(bench))),
        upcoming: Some(Box::new(move |upcoming: Upcoming| {
            let named = announced.name_press(name_of(upcoming.press));
            unless_gone(named.and_then(|()| announced.schedule(upcoming.begins)));
        })),
        gel,
        bench: Some(shared),
        begins_anew: true,
    })
}

/// Ignores the error of a bench that has ended, because the next call of its devices reports the same error.
fn unless_gone(done: Result<(), DriverError>) {
    drop(done);
}

/// Version of the bench, and digests of its built-in parameters.
pub(in crate::cmd) fn models() -> String {
    let digests = Model::ALL.map(|model| model.parameters().digest().to_string());
    format!("bench {MODEL_VERSION}: {}", digests.join(" "))
}

/// First 64 bits of the id of a press.
fn name_of(press: ContentId) -> u64 {
    let digits = press.to_string();
    let first = digits
        .get(..16)
        .and_then(|first| u64::from_str_radix(first, 16).ok());
    first.expect("a digest is written as 32 hexadecimal digits")
}

/// Clock of a simulated bench, which also changes its specimens.
struct BenchClock(Arc<dyn SimulatedBench>);

impl Timekeeper for BenchClock {
    fn now_s(&self) -> f64 {
        Stamp::at(self.0.now()).valid_s
    }

    fn rest(&mut self, rest: Duration) {
        unless_gone(self.0.rest(rest));
    }
}

impl SpecimenChanger for BenchClock {
    fn mount(&mut self, specimen: Specimen, _: Deadline) -> Result<(), DriverError> {
        self.0.mount(specimen)
    }
}
