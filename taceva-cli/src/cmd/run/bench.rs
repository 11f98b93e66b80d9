//! What the simulated bench has beside its devices: a clock that turns as fast as it is worked out, and hands that change specimens.

use std::sync::Arc;
use std::time::Duration;

use taceva_core::{Deadline, DriverError, Rig, SimulatedBench, Specimen, Stamp};
use taceva_drivers::Selector;
use taceva_protocol::{ContentId, SpecimenChanger, Timekeeper};
use taceva_sim::{MODEL_VERSION, Model};
use taceva_study::{Surroundings, Upcoming};

/// The surroundings of the rig whose robot was opened by `robot`; `None` where that is of no simulated bench.
pub(in crate::cmd) fn surroundings(robot: &Selector, rig: &mut Rig) -> Option<Surroundings> {
    let bench = rig.bench(&robot.bench()?)?;
    let gel = bench.provenance();
    let [announced, shared] = [0; 2].map(|_| Arc::clone(&bench));
    Some(Surroundings {
        clock: Box::new(Hands(Arc::clone(&bench))),
        specimens: Some(Box::new(Hands(bench))),
        upcoming: Some(Box::new(move |upcoming: Upcoming| {
            let named = announced.name_press(name_of(upcoming.press));
            unless_gone(named.and_then(|()| announced.schedule(upcoming.begins)));
        })),
        gel,
        bench: Some(shared),
        begins_anew: true,
    })
}

/// Leaves a bench that is gone to the next call of one of its devices, which meets the same end and can say so.
fn unless_gone(done: Result<(), DriverError>) {
    drop(done);
}

/// What the bench is a model of: its version and the parameters that are built in.
pub(in crate::cmd) fn models() -> String {
    let digests = Model::ALL.map(|model| model.parameters().digest().to_string());
    format!("bench {MODEL_VERSION}: {}", digests.join(" "))
}

/// The first 64 bits of the name of a press.
fn name_of(press: ContentId) -> u64 {
    let digits = press.to_string();
    let first = digits
        .get(..16)
        .and_then(|first| u64::from_str_radix(first, 16).ok());
    first.expect("a digest is written as 32 hexadecimal digits")
}

/// The clock and the hands of a bench.
struct Hands(Arc<dyn SimulatedBench>);

impl Timekeeper for Hands {
    fn now_s(&self) -> f64 {
        Stamp::at(self.0.now()).valid_s
    }

    fn rest(&mut self, rest: Duration) {
        unless_gone(self.0.rest(rest));
    }
}

impl SpecimenChanger for Hands {
    fn mount(&mut self, specimen: Specimen, _: Deadline) -> Result<(), DriverError> {
        self.0.mount(specimen)
    }
}
