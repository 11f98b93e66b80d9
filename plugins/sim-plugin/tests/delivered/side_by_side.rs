//! C and Rust plugins, built with different compilers and flags, are open at the same time.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

use taceva_conformance::{self as conformance, Report, Trial};
use taceva_core::{
    Args, Changer, Deadline, Device, Factory, ForceTransducer, FrameMut, Lighting, Rig, Robot,
    Sensor, Stamp, Wrench,
};
use taceva_host::{PluginDriver, PluginHost};
use taceva_sim::{ForceTransducerFactory, Model, SensorFactory};
use tempfile::TempDir;

use crate::built::{Delivery, host, lay_bench, lay_c};

/// Builds of the C example: the word in the plugin's id, the compiler and its flags.
const C_BUILDS: [(&str, &str, &str); 3] = [
    ("plain", "cc", "-O0"),
    ("whole", "cc", "-O3 -flto"),
    ("other", "clang", "-O2"),
];

/// Builds of the bench in Rust: the development profile, and all features of this processor.
const RUST_BUILDS: [(&str, &[&str]); 2] = [
    ("development", &[]),
    ("native", &["-Ctarget-cpu=native", "-Copt-level=3"]),
];

/// Installs each possible build of the C example in a separate folder. Returns the words in the ids of these plugins.
fn lay_all_c(folder: &Path) -> Vec<&'static str> {
    C_BUILDS
        .into_iter()
        .filter(|(word, compiler, level)| lay_c(&folder.join(word), word, compiler, level))
        .map(|(word, ..)| word)
        .collect()
}

pub(crate) fn plugins_of_different_languages_and_flags_keep_their_contracts_in_one_process() {
    let scratch = TempDir::new().expect("a folder");
    let c = lay_all_c(scratch.path());
    lay_bench(&scratch.path().join("bench"), &[]);
    let host = host(scratch.path(), Delivery::InProcess);
    assert_eq!(host.plugins().len(), 1 + c.len());

    let trial = Trial::default();
    let mut reports: Vec<Report> = Vec::new();
    for driver in host.drivers::<dyn Sensor>() {
        reports.push(conformance::sensor(&*driver, &trial));
    }
    for driver in host.drivers::<dyn Robot>() {
        reports.push(conformance::robot(&*driver, &trial));
    }
    for driver in host.drivers::<dyn ForceTransducer>() {
        reports.push(conformance::force(&*driver, &trial));
    }
    for driver in host.drivers::<dyn Lighting>() {
        reports.push(conformance::lighting(&*driver, &trial));
    }
    for driver in host.drivers::<dyn Changer>() {
        reports.push(conformance::changer(&*driver, &trial));
    }
    assert_eq!(reports.len(), 7 + 5 * c.len());
    for report in reports {
        assert!(report.passed(), "{report}");
    }
}

/// Number of frames and readings from each plugin, taken in turn.
const ROUNDS: usize = 5;
/// Deadline that suffices on a busy machine.
const PATIENT: Deadline = Deadline::after(std::time::Duration::from_secs(20));

/// A sensor and a force transducer of one plugin, and their data.
struct Pair {
    sensor: Box<dyn Sensor>,
    force: Box<dyn ForceTransducer>,
    gave: Vec<(Vec<u8>, Stamp, Wrench)>,
}

impl Pair {
    fn open(
        sensor: (&dyn Factory<dyn Sensor>, &str),
        force: (&dyn Factory<dyn ForceTransducer>, &str),
    ) -> Pair {
        let mut rig = Rig::new();
        let mut pair = Pair {
            sensor: open(sensor, &mut rig),
            force: open(force, &mut rig),
            gave: Vec::new(),
        };
        pair.sensor.start(PATIENT).expect("it starts");
        pair.force.start(PATIENT).expect("it starts");
        pair
    }

    fn of(host: &Arc<PluginHost>, sensor: (&str, &str), force: (&str, &str)) -> Pair {
        let sensors = drivers::<dyn Sensor>(host);
        let forces = drivers::<dyn ForceTransducer>(host);
        Pair::open(
            (&*sensors[sensor.0], sensor.1),
            (&*forces[force.0], force.1),
        )
    }

    fn take(&mut self) {
        let info = self.sensor.frame_info();
        let mut pixels = vec![0; info.byte_len().expect("a small frame")];
        let into = FrameMut::new(info, &mut pixels).expect("made for it");
        let stamp = self.sensor.capture(into, PATIENT).expect("a frame");
        let (wrench, _) = self.force.read(PATIENT).expect("a reading");
        self.gave.push((pixels, stamp, wrench));
    }
}

fn open<D: Device + ?Sized>(
    (factory, arguments): (&dyn Factory<D>, &str),
    rig: &mut Rig,
) -> Box<D> {
    let args = Args::parse(factory.descriptor().arguments(), arguments).expect("as declared");
    factory.open(&args, rig).expect("it opens")
}

/// Drivers of a kind, by the parts of their keys before and after the `/`.
fn drivers<D>(host: &Arc<PluginHost>) -> BTreeMap<String, Box<dyn Factory<D>>>
where
    D: Device + ?Sized,
    PluginDriver: Factory<D>,
{
    let drivers = host.drivers::<D>().into_iter();
    drivers
        .map(|driver| (driver.descriptor().key().to_string(), driver))
        .collect()
}

/// Data of the bench that is linked into this program.
fn linked() -> Pair {
    let sensor = SensorFactory::new(Model::GelSight).expect("a driver");
    let force = ForceTransducerFactory::new().expect("a driver");
    Pair::open((&sensor, SENSOR_ARGUMENTS), (&force, ""))
}

const SENSOR_ARGUMENTS: &str = "seed=3;unit=1";

pub(crate) fn c_and_rust_plugins_of_four_builds_give_right_frames_and_wrenches_while_all_are_open()
{
    let scratch = TempDir::new().expect("a folder");
    let c = lay_all_c(&scratch.path().join("c"));
    for (word, flags) in RUST_BUILDS {
        lay_bench(&scratch.path().join(word), flags);
    }
    let mut expected = linked();
    (0..ROUNDS).for_each(|_| expected.take());

    // The children of one delivery are open while this process loads the libraries of the other.
    let mut in_c: Vec<Pair> = Vec::new();
    let mut in_rust: Vec<Pair> = Vec::new();
    for delivery in [Delivery::InProcess, Delivery::Child] {
        if !c.is_empty() {
            let host = host(&scratch.path().join("c"), delivery);
            for word in &c {
                let [sensor, force] =
                    ["bar", "load"].map(|key| format!("org.example.{word}/{key}"));
                in_c.push(Pair::of(&host, (&sensor, ""), (&force, "load=12.5")));
            }
        }
        // Two builds have the same id, so each has its own host.
        for (word, _) in RUST_BUILDS {
            let host = host(&scratch.path().join(word), delivery);
            in_rust.push(Pair::of(
                &host,
                ("org.taceva.sim/gelsight", SENSOR_ARGUMENTS),
                ("org.taceva.sim/force-transducer", ""),
            ));
        }
    }
    for _ in 0..ROUNDS {
        in_c.iter_mut().chain(&mut in_rust).for_each(Pair::take);
    }

    assert_eq!((in_c.len(), in_rust.len()), (2 * c.len(), 4));
    for pair in &in_rust {
        assert!(pair.gave == expected.gave, "the linked bench gives others");
    }
    for pair in &in_c {
        for (number, (pixels, _, wrench)) in pair.gave.iter().enumerate() {
            let bar = |column| if column == number { 250 } else { 40 };
            let row: Vec<u8> = (0..64).map(bar).collect();
            assert!(
                pixels.chunks_exact(64).all(|found| found == row),
                "{number}"
            );
            assert_eq!(*wrench, load(12.5));
        }
    }
}

/// A load along the z axis of the sensor, N.
fn load(newton: f64) -> Wrench {
    let mut wrench = Wrench::default();
    wrench.force[2] = taceva_core::Newton(newton);
    wrench
}
