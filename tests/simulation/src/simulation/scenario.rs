//! Scenario of one seed: a gel, a plan, faults, and as many processes as the study needs.

use std::panic::{AssertUnwindSafe, catch_unwind, resume_unwind};

use taceva_core::{
    Axes, Descriptor, DescriptorSpec, DriverKey, DriverSource, Facts, Footprint, ForceFacts, Hertz,
    Millimetre, Newton, Robot, RobotFacts, SensorFacts,
};

use super::devices::{FRAME, SimulatedForce, SimulatedRobot, SimulatedSensor};
use super::disk::Disk;
use super::draws::Draws;
use super::fault::{FaultCounts, Faults};
use super::gel::Gel;
use super::guard::Guard;
use super::journal::{Journal, entries};
use super::oracle::{Checks, Oracle, Stated, Violation};
use super::record::{judge_log, missing};
use super::world::Sabotage;
use super::world_handle::{Killed, Shared};
use taceva_protocol::{
    Cancel, ContentId, Controls, Devices, Enabling, Event, Left, Mode, Oversight, Plan, RigInfo,
    RunError, RunSpec, Scene, SceneError, Setting, SharedSupervisor, SourceInfo, StopCause,
    Supervisor, Trip, plan, run, run_guarded,
};

/// Result of running the scenario of one seed.
#[derive(Clone, Debug, PartialEq)]
pub struct SimulationReport {
    /// Seed of the scenario.
    pub seed: u64,
    /// Violated invariants.
    pub violations: Vec<Violation>,
    /// Number of calls hit by each kind of fault.
    pub struck: FaultCounts,
    /// Number of checks of each invariant.
    pub checks: Checks,
    /// Number of processes until the study finished.
    pub processes: u32,
    /// Simulated time, s.
    pub simulated_s: f64,
}

/// Maximum number of processes. Faults are few and temporary, so more processes mean that there is no progress.
const MOST_PROCESSES: u32 = 40;
/// Time between two processes, in which a person repairs the rig, s.
const REPAIR_S: f64 = 3.0;
/// Longest wait of a run for the enabling switch, s.
const PATIENCE_S: f64 = 20.0;

/// Runs the scenario of `seed` to its end.
///
/// ```
/// use taceva_simulation::simulation::simulate;
/// let report = simulate(1);
/// assert!(report.violations.is_empty(), "seed {}: {:?}", report.seed, report.violations);
/// ```
pub fn simulate(seed: u64) -> SimulationReport {
    simulate_with(seed, Sabotage::Nothing)
}

/// Same as [`simulate`], with a bug planted in the simulated world.
pub(super) fn simulate_with(seed: u64, sabotage: Sabotage) -> SimulationReport {
    let draws = Draws::new(seed, "faults");
    let part = |purpose| draws.fraction([purpose, 1]);
    let noise_n = 0.002 + 0.004 * part(101);
    let gel = Gel {
        stiffness_n_mm: 0.3 + 2.5 * part(100),
        noise_n,
        // A monitored rig is a real one, on which the host determines the zero.
        zero_noise_n: if is_guarded(seed) { noise_n } else { 0.0 },
        saturation_n: 20.0,
        normal_max_n: 0.6 + 1.5 * part(102),
        // Every second robot reports the commanded position; the others deviate by up to 0.05 mm.
        pose_noise_mm: 0.1 * (part(103) - 0.5).max(0.0),
        slope: 0.0,
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
        gel.force_error_n(),
        step_mm,
        threshold_n,
    )
    .at_speed(
        plan.contact.speed_mm_s.value,
        match is_guarded(seed) {
            // Threads observe the robot within a segment of any length.
            true => 0.0,
            false => limits.overshoot.segment_mm,
        },
    );
    let plan = match sabotage {
        Sabotage::LooseLimits => loosened(&plan),
        _ => plan.clone(),
    };
    let faults = Faults::draw(draws, plan.cost.minutes * 60.0);
    let shared = Shared::new(
        gel,
        Oracle::new(stated),
        faults,
        Draws::new(seed, "readings"),
    );
    shared.world().sabotage = sabotage;
    let mut disk = Disk::new(shared.clone(), Draws::new(seed, "disk"));
    let mut acknowledged = Vec::new();
    let mut processes = 0;
    let mut finished = false;
    let mut lost = Vec::new();
    let mut redone = 0;
    while !finished && processes < MOST_PROCESSES {
        processes += 1;
        finished = match process(
            &plan,
            seed,
            &shared,
            &mut disk,
            &mut acknowledged,
            &mut redone,
        ) {
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
    let mut violations = std::mem::take(&mut world.oracle.violations);
    violations.append(&mut lost);
    violations.append(&mut found.violations);
    let mut checks = world.oracle.checks;
    checks.samples = found.samples;
    checks.redone = redone;
    SimulationReport {
        seed,
        violations,
        struck: world.faults.struck(),
        checks,
        processes,
        simulated_s: world.now_s,
    }
}

/// True if threads monitor the robot of this seed during motions.
fn is_guarded(seed: u64) -> bool {
    seed % 4 == 3
}

/// Returns `plan` with the limit of the normal force raised by half.
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

/// One process: opens the log, runs the missing presses, and ends in one of several ways.
fn process(
    plan: &Plan,
    seed: u64,
    shared: &Shared,
    disk: &mut Disk,
    acknowledged: &mut Vec<ContentId>,
    redone: &mut u64,
) -> Ended {
    let cancel = Cancel::new();
    shared.world().cancel = cancel.clone();
    if is_guarded(seed) && shared.world().is_unplugged() {
        // A program that does not find the switch opens no other device.
        return Ended::Stopped(Box::new(RunError {
            press: None,
            cause: StopCause::Tripped(Trip::SwitchLost),
            left: Left::Untouched,
        }));
    }
    let mut robot = SimulatedRobot(shared.clone());
    let limits = plan.limits.clone().filter(|_| is_guarded(seed));
    let guard =
        limits.map(|limits| SharedSupervisor::new(Supervisor::new(limits, robot.halt_handle())));
    if let Some(guard) = &guard {
        // Counts as released until the thread first reads the switch.
        guard.lock().enabling(Enabling::Released);
    }
    let looking = guard.clone();
    let looking = looking.map(|guard| {
        let draws = Draws::new(seed, "threads");
        Guard::new(
            guard,
            cancel.clone(),
            draws,
            seed % 8 == 7,
            shared.world().now_s,
        )
    });
    shared.world().guard = looking;
    let mut force = SimulatedForce::new(shared.clone());
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
            events: &mut |event| *redone += u64::from(matches!(event, Event::Redone { .. })),
            operator: None,
        };
        match guard {
            Some(guard) => {
                let guard = Oversight::new(guard).with_patience_s(PATIENCE_S);
                run_guarded(&spec, devices, &mut log, controls, guard)
            }
            None => run(&spec, devices, &mut log, controls),
        }
    }));
    // The threads end with the process.
    shared.world().guard = None;
    match ended {
        Ok(Ok(_)) => Ended::Done,
        Ok(Err(error)) => Ended::Stopped(Box::new(error)),
        Err(thrown) if thrown.is::<Killed>() => Ended::Killed,
        Err(bug) => resume_unwind(bug),
    }
}

/// Simulates a person who frees the tip after a process. A killed process may leave the tip anywhere.
fn repair(shared: &Shared, left: Left) {
    let mut world = shared.world();
    world.oracle.killed();
    world.pass(REPAIR_S);
    world.halted = false;
    world.acknowledge();
    if left == Left::InPlace {
        world.lift();
    }
}

pub(super) fn scenario_plan(seed: u64, gel: &Gel) -> Result<Plan, SceneError> {
    let source = match is_guarded(seed) {
        true => DriverSource::Real,
        false => DriverSource::Simulated,
    };
    planned(SCENE, seed, gel, source)
}

/// Plan of the scene in `text`, on a simulated rig.
#[cfg(test)]
pub(super) fn planned_scene(text: &str, seed: u64, gel: &Gel) -> Result<Plan, SceneError> {
    planned(text, seed, gel, DriverSource::Simulated)
}

fn planned(text: &str, seed: u64, gel: &Gel, source: DriverSource) -> Result<Plan, SceneError> {
    let mut scene = Scene::parse("faults", text)?;
    let want = ["mae", "hysteresis", "intrinsic"].map(|id| Setting::default_of(id.to_owned()));
    scene.seed = seed;
    scene.metrics.want = Some(want.to_vec());
    let footprint = Footprint::rectangle(8.0, 10.0, Some(0.8)).ok();
    let described = |facts| described(source, facts);
    let source = SourceInfo::Rig(Box::new(RigInfo {
        sensor: described(Facts::Sensor(Box::new(
            SensorFacts::default()
                .with_frame(FRAME)
                .with_rate(Hertz(50.0))
                .with_footprint(footprint)
                .with_force_max(Newton(gel.normal_max_n)),
        ))),
        robot: described(Facts::Robot(
            RobotFacts::default().with_pose_noise(Millimetre(gel.pose_deviation_mm())),
        )),
        force: described(Facts::Force(
            ForceFacts::default()
                .with_axes(Axes::FORCE)
                .with_force_max(Newton(gel.saturation_n)),
        )),
        lighting: None,
    }));
    let mut plans = plan(&scene, |_| source.clone())?;
    Ok(plans.swap_remove(0))
}

fn described(source: DriverSource, facts: Facts) -> Option<Descriptor> {
    let key = DriverKey::fixed("faults/device");
    let spec = DescriptorSpec::new(key, "a simulated device", source, facts);
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
