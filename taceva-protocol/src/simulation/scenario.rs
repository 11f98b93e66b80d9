//! One seed: a gel, a plan, faults, and as many processes as it takes to finish.

use std::collections::BTreeSet;
use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

use taceva_core::{
    Axes, Descriptor, DescriptorSpec, DriverKey, DriverSource, Facts, Field, FieldSet, Footprint,
    ForceFacts, Hertz, Newton, Phase, RobotFacts, SensorFacts,
};

use super::devices::{FRAME, SimulatedForce, SimulatedRobot, SimulatedSensor};
use super::disk::Disk;
use super::fault::{FaultCounts, Faults, fraction};
use super::journal::{Entry, EntrySample, Journal, entries};
use super::judge::{Checks, Judge, Stated, Violation};
use super::world::{Gel, Killed, Sabotage, Shared};
use crate::draw::Draws;
use crate::plan::{MetricNeeds, Plan, PlannedPress, plan_study};
use crate::press::Motion;
use crate::run::{Cancel, Controls, Devices, Left, Mode, Outcome, RunError, RunSpec, run};
use crate::scene::{Scene, SceneError};
use crate::source::{RigInfo, SourceInfo};

/// What a seed showed.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulationReport {
    /// The seed.
    pub seed: u64,
    /// What must never happen and did.
    pub violations: Vec<Violation>,
    /// How often each kind of fault struck.
    pub struck: FaultCounts,
    /// How often each thing that must hold was looked at.
    pub checks: Checks,
    /// Processes it took to finish.
    pub processes: u32,
    /// Simulated time, in s.
    pub simulated_s: f64,
}

/// Faults are few and end; whoever needs more processes than this goes round in circles.
const MOST_PROCESSES: u32 = 40;
/// A robot that sticks in the last segment of a way leaves its sample so far from the station; the label says where it really was.
const LAG_MM: f64 = 0.015 + 1e-6;
/// Between two processes a person looks at the rig, in s.
const REPAIR_S: f64 = 3.0;

/// Plays `seed` to its end.
///
/// ```
/// use taceva_protocol::simulation::simulate;
/// let report = simulate(1);
/// assert!(report.violations.is_empty(), "seed {}: {:?}", report.seed, report.violations);
/// ```
pub fn simulate(seed: u64) -> SimulationReport {
    simulate_with(seed, Sabotage::Nothing)
}

/// As [`simulate`], with a planted mistake.
pub(super) fn simulate_with(seed: u64, sabotage: Sabotage) -> SimulationReport {
    let draws = Draws::new(seed, "faults");
    let part = |purpose| fraction(draws, [purpose, 1]);
    let gel = Gel {
        stiffness_n_mm: 0.3 + 2.5 * part(100),
        noise_n: 0.002 + 0.004 * part(101),
        saturation_n: 20.0,
        normal_max_n: 0.6 + 1.5 * part(102),
    };
    let plan = match scenario_plan(seed, &gel) {
        Ok(plan) => plan,
        Err(error) => return unplanned(seed, &error),
    };
    let Some(limits) = &plan.limits else {
        return unfinished(seed, "a plan without limits");
    };
    let (step_mm, threshold_n) = (plan.contact.step_mm.value, plan.contact.threshold_n.value);
    let stated = Stated::new(
        limits,
        gel.stiffness_n_mm,
        gel.noise_n,
        step_mm,
        threshold_n,
    );
    let plan = match sabotage {
        Sabotage::LooseLimits => loosened(&plan),
        _ => plan.clone(),
    };
    let faults = Faults::draw(draws, plan.cost.minutes * 60.0);
    let shared = Shared::new(
        gel,
        Judge::new(stated),
        faults,
        Draws::new(seed, "readings"),
    );
    shared.world().sabotage = sabotage;
    let mut disk = Disk::new(shared.clone(), Draws::new(seed, "disk"));
    let mut acknowledged = Vec::new();
    let mut processes = 0;
    let mut finished = false;
    let mut lost = Vec::new();
    while !finished && processes < MOST_PROCESSES {
        processes += 1;
        finished = match process(&plan, &shared, &mut disk, &mut acknowledged) {
            Ended::Done => true,
            Ended::Stopped(error) => {
                repair(&shared, error.left);
                false
            }
            Ended::Killed => {
                disk.crash();
                lost.extend(missing(&disk.read(), &acknowledged));
                repair(&shared, Left::Clear);
                false
            }
        };
    }
    let mut world = shared.world();
    let (kept, _) = entries(&disk.read());
    let mut found = judge_log(&plan, &kept, &acknowledged, &gel);
    if !finished {
        let what = format!("after {processes} processes");
        found.violations.push(Violation::Unfinished(what));
    }
    let mut violations = std::mem::take(&mut world.judge.violations);
    violations.append(&mut lost);
    violations.append(&mut found.violations);
    let mut checks = world.judge.checks;
    checks.samples = found.samples;
    SimulationReport {
        seed,
        violations,
        struck: world.faults.struck(),
        checks,
        processes,
        simulated_s: world.now_s,
    }
}

/// The plan with a limit that nobody may loosen, loosened.
fn loosened(plan: &Plan) -> Plan {
    let mut plan = plan.clone();
    if let Some(limits) = &mut plan.limits {
        limits.normal_max.0 *= 1.5;
    }
    plan
}

enum Ended {
    Done,
    Stopped(Box<RunError>),
    Killed,
}

/// One process: it opens the log, runs what is missing, and ends one way or another.
fn process(
    plan: &Plan,
    shared: &Shared,
    disk: &mut Disk,
    acknowledged: &mut Vec<crate::Digest>,
) -> Ended {
    let cancel = Cancel::new();
    shared.world().cancel = cancel.clone();
    let mut robot = SimulatedRobot(shared.clone());
    let mut force = SimulatedForce(shared.clone());
    let mut sensor = SimulatedSensor(shared.clone());
    let mut clock = shared.clone();
    let mut log = Journal::open(disk, acknowledged);
    let spec = RunSpec {
        plan,
        unit: &plan.units[0],
        mode: Mode::Acquire,
    };
    let ended = catch_unwind(AssertUnwindSafe(|| {
        let devices = Devices {
            robot: &mut robot,
            force: &mut force,
            sensor: Some(&mut sensor),
            lighting: None,
            specimens: None,
        };
        let controls = Controls {
            clock: &mut clock,
            cancel: &cancel,
            events: &mut |_| {},
        };
        run(&spec, devices, &mut log, controls)
    }));
    match ended {
        Ok(Ok(_)) => Ended::Done,
        Ok(Err(error)) => Ended::Stopped(Box::new(error)),
        Err(thrown) if thrown.is::<Killed>() => Ended::Killed,
        Err(bug) => resume_unwind(bug),
    }
}

/// A person frees the tip if it was left in place; whoever was killed left it wherever it was, for the next process to find.
fn repair(shared: &Shared, left: Left) {
    let mut world = shared.world();
    world.judge.killed();
    world.pass(REPAIR_S);
    world.halted = false;
    if left == Left::InPlace {
        world.lift();
    }
}

struct Found {
    violations: Vec<Violation>,
    samples: u64,
}

/// Compares what is on the disk with what was planned, acknowledged and true.
fn judge_log(plan: &Plan, kept: &[Entry], acknowledged: &[crate::Digest], gel: &Gel) -> Found {
    let mut found = Found {
        violations: Vec::new(),
        samples: 0,
    };
    let mut seen = BTreeSet::new();
    for entry in kept {
        if !seen.insert(entry.press) {
            found
                .violations
                .push(Violation::Doubled(entry.press.to_string()));
        }
        found.compare(plan, entry, gel);
    }
    found.violations.extend(lost(&seen, acknowledged));
    for planned in &plan.presses {
        if !seen.contains(&planned.id) {
            found
                .violations
                .push(Violation::Lost(format!("{} was planned", planned.id)));
        }
    }
    found
}

/// A press whose way out has not the stations of its way in, although it was planned so. One may lack: a limit just below a station leaves
/// its way in with two samples nearly as deep.
fn one_sided(planned: &PlannedPress, entry: &Entry) -> Option<Violation> {
    let stations = planned.press.stations();
    let on_way_out = |sample: &&EntrySample| {
        let station = usize::try_from(sample.number).ok();
        let station = station.and_then(|number| stations.get(number));
        station.is_some_and(|station| station.phase == Phase::Unload)
    };
    let comes_out = stations
        .iter()
        .any(|station| station.phase == Phase::Unload);
    let samples = entry.samples.len();
    let out = entry.samples.iter().filter(on_way_out).count();
    (comes_out && !(2 * out..=2 * out + 1).contains(&samples)).then(|| {
        let what = format!(
            "{} has {out} samples of {samples} on its way out",
            entry.press
        );
        Violation::Untrue(what)
    })
}

/// What was acknowledged and is not in the file any more: a press that is made again was lost all the same.
fn missing(file: &[u8], acknowledged: &[crate::Digest]) -> Vec<Violation> {
    let (kept, _) = entries(file);
    let seen = kept.iter().map(|entry| entry.press).collect();
    lost(&seen, acknowledged).collect()
}

fn lost<'a>(
    seen: &'a BTreeSet<crate::Digest>,
    acknowledged: &'a [crate::Digest],
) -> impl Iterator<Item = Violation> + 'a {
    let gone = acknowledged.iter().filter(|press| !seen.contains(press));
    gone.map(|press| Violation::Lost(press.to_string()))
}

impl Found {
    fn compare(&mut self, plan: &Plan, entry: &Entry, gel: &Gel) {
        let name = entry.press;
        let Some(planned) = plan.presses.iter().find(|planned| planned.id == name) else {
            self.violations.push(Violation::Invented(name.to_string()));
            return;
        };
        let samples = entry.samples.len();
        let whole = samples == planned.press.samples();
        let limited = entry.samples.iter().filter(|sample| sample.is_limited);
        let fits = match entry.outcome {
            Outcome::Complete => whole && limited.count() == 0,
            // Without a sample the limit was reached in the search.
            Outcome::Limited => samples == 0 || limited.count() > 0,
            Outcome::NoContact => false,
        };
        let numbers = entry.samples.iter().map(|sample| sample.number);
        let in_order = match entry.outcome {
            Outcome::Complete => numbers.eq(0..u32::try_from(samples).unwrap_or(u32::MAX)),
            _ => numbers.is_sorted_by(|one, next| one < next),
        };
        if !fits || !in_order {
            let what = format!("{name} ended as {:?} with {samples} samples", entry.outcome);
            self.violations.push(Violation::Invented(what));
        }
        self.violations.extend(one_sided(planned, entry));
        let stations = planned.press.stations();
        let mut height = None;
        for sample in &entry.samples {
            let place = sample.number;
            self.samples += 1;
            let mut untrue = |what: String| self.violations.push(Violation::Untrue(what));
            let station = usize::try_from(place)
                .ok()
                .and_then(|place| stations.get(place));
            if let Some(station) = station {
                let depth_mm = station.depth.to_millimetres();
                let off_mm = sample.depth_mm - depth_mm;
                if off_mm > LAG_MM || (off_mm < -LAG_MM && !sample.is_limited) {
                    untrue(format!(
                        "{name}/{place} is {} mm deep, not {depth_mm}",
                        sample.depth_mm
                    ));
                }
            }
            if sample.is_limited && sample.force_n > gel.normal_max_n + gel.noise_n {
                untrue(format!(
                    "{name}/{place} rests at {} N, beyond the limit",
                    sample.force_n
                ));
            }
            if sample.frame.is_some() != planned.frames {
                untrue(format!("{name}/{place} has a frame or lacks one"));
            }
            let Some([exposed_s, height_mm, force_n]) = sample.frame else {
                continue;
            };
            if (sample.stamp_s - exposed_s).abs() > 1e-9 {
                untrue(format!("{name}/{place} shows a frame of another time"));
            }
            if (sample.force_n - force_n).abs() > gel.noise_n + 1e-9 {
                untrue(format!(
                    "{name}/{place} has {} N, its frame {force_n} N",
                    sample.force_n
                ));
            }
            if let Motion::Indent(_) = planned.press.motion {
                // The contact is at one height for all samples of a press.
                let contact_mm = height_mm - sample.depth_mm;
                let first: f64 = *height.get_or_insert(contact_mm);
                if (contact_mm - first).abs() > 1e-6 {
                    untrue(format!("{name}/{place} shows a frame of another height"));
                }
            }
        }
    }
}

pub(super) fn scenario_plan(seed: u64, gel: &Gel) -> Result<Plan, SceneError> {
    let scene = Scene::parse("faults", SCENE)?;
    let scene = Scene { seed, ..scene };
    let truth = FieldSet::EMPTY.with(Field::Truth);
    let needs = [
        MetricNeeds::new("mae", FieldSet::PAIRS, &[]),
        MetricNeeds::new("hysteresis", truth.with(Field::Phase), &["Pz", "Fz"]),
        MetricNeeds::new(
            "intrinsic",
            FieldSet::EMPTY.with(Field::Stamp).with(Field::Frame),
            &[],
        ),
    ];
    let footprint = Footprint::rectangle(8.0, 10.0, Some(0.8)).ok();
    let source = SourceInfo::Rig(Box::new(RigInfo {
        sensor: described(Facts::Sensor(Box::new(SensorFacts {
            frame: Some(FRAME),
            rate: Some(Hertz(50.0)),
            footprint,
            force_max: Some(Newton(gel.normal_max_n)),
            ..SensorFacts::default()
        }))),
        robot: described(Facts::Robot(RobotFacts::default())),
        force: described(Facts::Force(ForceFacts {
            axes: Axes::FORCE,
            force_max: Some(Newton(gel.saturation_n)),
            ..ForceFacts::default()
        })),
        lighting: None,
    }));
    plan_study(&scene, &scene.studies[0], &source, &needs)
}

fn described(facts: Facts) -> Option<Descriptor> {
    let key = DriverKey::fixed("faults/device");
    let spec = DescriptorSpec::new(key, "a simulated device", DriverSource::Simulated, facts);
    spec.check().ok()
}

const SCENE: &str = r#"
scene_version = 1
name = "faults"
sensor = { driver = "faults/sensor" }
robot = { driver = "faults/robot" }
force = { driver = "faults/force" }
model = { name = "ridge" }
[protocol]
contact = { clearance_mm = 0.5, search_mm = 1.0 }
calibration = { points = 3, indentations = 2 }
hysteresis = { points = 2, depth_step_mm = 0.4 }
idle = { frames = 3 }
"#;

fn unplanned(seed: u64, error: &SceneError) -> SimulationReport {
    unfinished(seed, &error.to_string())
}

fn unfinished(seed: u64, what: &str) -> SimulationReport {
    SimulationReport {
        seed,
        violations: vec![Violation::Unfinished(what.to_owned())],
        struck: FaultCounts::default(),
        checks: Checks::default(),
        processes: 0,
        simulated_s: 0.0,
    }
}
