//! Tests of the monitor with sensors of the simulated bench. `TACEVA_UNTOUCHED=300000 TACEVA_TRIALS=200 cargo test --release -p taceva-stress --test
//! stress bench_monitor:: -- --nocapture` watches as many pictures of all four sensors, and tries each fault as often. Otherwise few pictures of one
//! sensor are watched.

use taceva_core::{Frame, FrameMut};
use taceva_sim::Model;
use taceva_sim::contact::{Indentation, Solid};
use taceva_sim::optics::{Camera, CameraSpec, OpticsSpec, Stimulus, View};
use taceva_stress::{FAULTS, Fault, Monitor, Scope, Stress};

/// Longer and shorter side of the pictures.
const SIDES: [u32; 2] = [96, 72];
/// Number of untouched pictures that the monitor needs before it can find changes.
const LEARNT: u32 = 250;
/// Number of pictures within which the monitor must find a fault.
const WITHIN: u32 = 30;
/// Stimulus of the tested faults: change of the picture, divided by the change by contact.
const STIMULUS: f64 = 0.3;

/// All sensors if the environment variable `name` is set, otherwise one sensor, so that the tests stay short.
fn sensors(name: &str) -> Vec<Model> {
    match std::env::var_os(name) {
        Some(_) => Model::ALL.to_vec(),
        None => vec![Model::GelSight],
    }
}

/// Number in the environment variable `name`, or `otherwise` if it is not set.
fn wanted(name: &str, otherwise: u32) -> u32 {
    std::env::var(name)
        .ok()
        .map_or(otherwise, |text| text.parse().expect("a number"))
}

/// Sensor of the bench, with its monitor.
struct Watched {
    model: Model,
    camera: Camera,
    /// Picture without noise.
    clean: Frame,
    contact: f64,
    monitor: Monitor,
}

impl Watched {
    /// Creates the sensor, whose monitor has already set its limits.
    fn new(model: Model) -> Watched {
        let parameters = model.parameters();
        let spec = OpticsSpec::new(&parameters);
        let [longer, shorter] = SIDES;
        let size = match spec.native[1] > spec.native[0] {
            true => [shorter, longer],
            false => [longer, shorter],
        };
        let mut quiet = spec.clone();
        quiet.camera = CameraSpec::QUIET;
        let mut quiet = Camera::new(&quiet, size, 0, 7).expect("a small frame");
        let clean = taken(&mut quiet, &View::default());
        let mut camera = Camera::new(&spec, size, 0, 7).expect("a small frame");
        let reference = untouched(&mut camera, 0);
        let solid = Solid::new(&parameters);
        let probing = &parameters.probing;
        let presses = (0..12_u32).map(|number| {
            let turn = f64::from(number);
            let (sin, cos) = (2.399_963 * turn).sin_cos();
            let out = 0.8 * (turn / 12.0).sqrt();
            let depth_mm = probing.depth_max_mm * (0.4 + 0.6 * (turn * 0.618).fract());
            let contact = solid.contact(&Indentation {
                place_mm: [
                    probing.half_width_mm * out * cos,
                    probing.half_height_mm * out * sin,
                ],
                depth_mm,
                deepest_mm: depth_mm,
                shear_mm: [0.0, 0.0],
                indenter_radius_mm: 2.0,
                stiffness: 1.0,
            });
            let view = View {
                stimulus: Stimulus::Ball(contact),
                picture: 500_000 + number,
                ..View::default()
            };
            difference(&taken(&mut camera, &view), &reference)
        });
        let contact = presses.sum::<f64>() / 12.0;
        let mut monitor = Monitor::new(reference, contact).expect("a monitor");
        for number in 1..=LEARNT {
            let alarms = monitor.untouched(&untouched(&mut camera, number));
            let alarms = alarms.expect("of the same kind");
            assert!(alarms.is_empty(), "{model}: {alarms:?}");
        }
        Watched {
            model,
            camera,
            clean,
            contact,
            monitor,
        }
    }

    /// Parameter at which `fault` changes the clean picture by [`STIMULUS`]; `None` if it cannot.
    fn parameter(&self, fault: &'static Fault, seed: u64) -> Option<f64> {
        let stimulus = |parameter: f64| {
            let stress = Stress::new(fault, parameter, seed);
            let draws = if fault.scope == Scope::Each { 16 } else { 1 };
            let changes = (0..draws).map(|draw| {
                let changed = stress.apply(&self.clean, &format!("draw {draw}"), None);
                difference(&changed, &self.clean)
            });
            changes.sum::<f64>() / (f64::from(draws) * self.contact)
        };
        let [mut low, mut high] = [1e-7 * fault.most, fault.most];
        if Stress::new(fault, high, seed).repeats() {
            // Share of repeated pictures of contact at this stimulus.
            return Some(0.25);
        }
        if stimulus(high) < STIMULUS {
            return None;
        }
        for _ in 0..16 {
            let middle = (low * high).sqrt();
            match stimulus(middle) < STIMULUS {
                true => low = middle,
                false => high = middle,
            }
        }
        Some(high)
    }

    /// True if the monitor finds the fault within [`WITHIN`] pictures.
    fn is_found(&mut self, fault: &'static Fault, parameter: f64, trial: u32) -> bool {
        let stress = Stress::new(fault, parameter, u64::from(trial));
        let mut monitor = self.monitor.clone();
        let first = 1_000_000 + trial * WITHIN;
        let mut before: Option<Frame> = None;
        for number in first..first + WITHIN {
            let frame = untouched(&mut self.camera, number);
            let faulty = stress.apply(&frame, &number.to_string(), before.as_ref());
            let alarms = monitor.untouched(&faulty).expect("of the same kind");
            if !alarms.is_empty() {
                return true;
            }
            before = Some(faulty);
        }
        false
    }
}

/// Takes a picture of `view`.
pub(crate) fn taken(camera: &mut Camera, view: &View) -> Frame {
    let info = camera.frame_info();
    let mut bytes = vec![0; info.byte_len().expect("a small frame")];
    let into = FrameMut::new(info, &mut bytes).expect("its own frame");
    camera.render(view, into).expect("a picture");
    Frame::new(info, bytes).expect("whole")
}

fn untouched(camera: &mut Camera, picture: u32) -> Frame {
    let view = View {
        picture,
        ..View::default()
    };
    taken(camera, &view)
}

/// Mean absolute difference over all pixel values, a fraction of full scale.
fn difference(one: &Frame, other: &Frame) -> f64 {
    let pairs = one.samples().zip(other.samples());
    let sum: u64 = pairs
        .map(|(one, other)| u64::from(one.abs_diff(other)))
        .sum();
    let numbers = one.samples().count();
    sum as f64 / (numbers as f64 * f64::from(one.info().format.full_scale()))
}

#[test]
#[expect(clippy::print_stdout, reason = "the counts are the result")]
fn untouched_pictures_of_the_bench_raise_no_alarm() {
    let count = wanted("TACEVA_UNTOUCHED", 300);
    for model in sensors("TACEVA_UNTOUCHED") {
        let Watched {
            mut camera,
            mut monitor,
            ..
        } = Watched::new(model);
        for number in LEARNT + 1..=LEARNT + count {
            let alarms = monitor.untouched(&untouched(&mut camera, number));
            let alarms = alarms.expect("of the same kind");
            assert!(alarms.is_empty(), "{model}, picture {number}: {alarms:?}");
        }
        println!("{model}: no alarm in {count} untouched pictures");
    }
}

#[test]
#[expect(clippy::print_stdout, reason = "the counts are the result")]
fn every_fault_that_changes_pictures_by_a_third_of_a_contact_is_found_within_thirty() {
    let trials = wanted("TACEVA_TRIALS", 3);
    let mut missed = Vec::new();
    for model in sensors("TACEVA_TRIALS") {
        let mut watched = Watched::new(model);
        for fault in FAULTS {
            let mut found = 0;
            let mut tried = 0;
            let mut parameter = None;
            for trial in 0..trials {
                // The change of other faults depends on no seed.
                if trial == 0 || fault.scope == Scope::Drawn {
                    parameter = watched.parameter(fault, u64::from(trial));
                }
                let Some(parameter) = parameter else {
                    continue;
                };
                tried += 1;
                found += u32::from(watched.is_found(fault, parameter, trial));
            }
            println!(
                "{}: {}: found in {found} of {tried}",
                watched.model, fault.id
            );
            // 5 % may be missed, or one of a few.
            if tried - found > (tried / 20).max(1) {
                missed.push(format!(
                    "{}: {}: {found} of {tried}",
                    watched.model, fault.id
                ));
            }
        }
    }
    assert!(missed.is_empty(), "{}", missed.join("\n"));
}
