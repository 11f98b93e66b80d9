//! What the simulated bench has beside its devices: a clock that turns as fast as it is worked out, and hands that change specimens.

use std::time::Duration;

use taceva_core::{Deadline, DriverError, DriverKey, ErrorKind, Rig};
use taceva_drivers::Selector;
use taceva_protocol::{Digest, Specimen, SpecimenChanger, Timekeeper};
use taceva_sim::{MODEL_VERSION, Model, Mounted, SimulatedRig};
use taceva_study::{Surroundings, Upcoming};

const ROBOT: DriverKey = DriverKey::fixed("sim/robot");

/// The surroundings of the rig whose robot was opened by `robot`; `None` for every robot but the simulated one.
pub(super) fn surroundings(robot: &Selector, rig: &mut Rig) -> Option<Surroundings> {
    if robot.driver() != ROBOT.as_str() {
        return None;
    }
    let mut arguments = robot.arguments().split(';').map(str::trim);
    let name = arguments.find_map(|argument| argument.strip_prefix("rig="));
    let bench = SimulatedRig::of(rig, name.unwrap_or("bench").trim());
    let gel = bench.provenance().map(|provenance| {
        format!(
            "bench {MODEL_VERSION}, parameters {}, seed {}",
            provenance.parameters, provenance.seed
        )
    });
    let announced = bench.clone();
    Some(Surroundings {
        clock: Box::new(Hands(bench.clone())),
        specimens: Some(Box::new(Hands(bench))),
        upcoming: Some(Box::new(move |upcoming: Upcoming| {
            announced.name_press(name_of(upcoming.press));
            announced.schedule(upcoming.begins);
        })),
        gel,
        begins_anew: true,
    })
}

/// What the bench is a model of: its version and the parameters that are built in.
pub(super) fn models() -> String {
    let digests = Model::ALL.map(|model| model.parameters().digest().to_string());
    format!("bench {MODEL_VERSION}: {}", digests.join(" "))
}

/// The first 64 bits of the name of a press.
fn name_of(press: Digest) -> u64 {
    let digits = press.to_string();
    let first = digits
        .get(..16)
        .and_then(|first| u64::from_str_radix(first, 16).ok());
    first.expect("a digest is written as 32 hexadecimal digits")
}

/// The clock and the hands of a bench.
struct Hands(SimulatedRig);

impl Timekeeper for Hands {
    fn now_s(&self) -> f64 {
        self.0.now_s()
    }

    fn rest(&mut self, rest: Duration) {
        self.0.rest(rest);
    }
}

impl SpecimenChanger for Hands {
    fn mount(&mut self, specimen: Specimen, _: Deadline) -> Result<(), DriverError> {
        let mounted = match specimen {
            Specimen::Sphere { radius } => Mounted::ball(radius),
            Specimen::Grating { kind, spacing } => Mounted::board(kind, spacing),
        };
        let done = mounted.and_then(|mounted| self.0.mount(mounted));
        done.map_err(|error| {
            DriverError::new(ErrorKind::InvalidArgument, &ROBOT, "mount a specimen").because(error)
        })
    }
}
