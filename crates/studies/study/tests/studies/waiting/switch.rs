//! Tests of an enabling switch while a run moves the robot.

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicU32, AtomicU64, Ordering};

use taceva_acquire::{AcquireError, RigCheck, RigProblem, check_rig, read_rig};
use taceva_core::{Progress, SilentProgress};
use taceva_dataset::Dataset;
use taceva_drivers::MonotonicClock;
use taceva_protocol::{Answer, Cancel, Left, Operator, Question, RunError, StopCause, Trip};
use taceva_study::StudyError;

use crate::waiting::devices::drivers;
use crate::waiting::record_on;
use crate::waiting::session::{Person, UPRIGHT, rig_file, scene};
use crate::waiting::world::World;

/// Path of a new rig file for the emulated rig, with the enabling switch `enable` in line 12.
fn rig_with(folder: &Path, enable: &str) -> PathBuf {
    let path = rig_file(folder, UPRIGHT);
    let mut text = std::fs::read_to_string(&path).expect("written");
    text.push_str(&format!(
        "[operator]\nenable = \"{enable}\"\npatience_s = 1.0\n"
    ));
    std::fs::write(&path, text).expect("written");
    path
}

fn recorded(world: &World, folder: &Path, progress: &dyn Progress) -> Result<Dataset, StudyError> {
    let rig = rig_with(folder, "wall/pedal");
    let person = Mutex::new(Person::default());
    let run = folder.join("run");
    record_on(world, &run, progress, (&scene(), Some(&rig), Some(&person)))
}

fn stopped(done: Result<Dataset, StudyError>) -> RunError {
    match done {
        Err(StudyError::Acquire(AcquireError::Acquisition { source, .. })) => *source,
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("it went on to its end"),
    }
}

fn depth_mm(world: &World) -> f64 {
    world.state().tip(MonotonicClock.now_s())[2]
}

fn assert_whole(dataset: &Dataset) {
    let mut names = dataset.table().samples().to_vec();
    names.sort();
    names.dedup();
    assert_eq!((names.len(), dataset.table().samples().len()), (6, 6));
}

/// Number of checks of the guard during which the switch is released.
const LOOKS: u32 = 40;
/// Number of checks of the guard within which a motion in progress must be halted.
const HALTED_LOOKS: u32 = 20;

/// Progress receiver that releases the switch when the tip is deep in the gel, and holds it again after [`LOOKS`] checks. Counts moves meanwhile.
struct LetsGo<'a> {
    world: &'a World,
    looks: AtomicU32,
    /// Depth of the tip in mm when the halt was due, as the bits of an `f64`.
    stood: AtomicU64,
    moved_looks: AtomicU32,
}

impl<'a> LetsGo<'a> {
    fn new(world: &'a World) -> LetsGo<'a> {
        LetsGo {
            world,
            looks: AtomicU32::new(0),
            stood: AtomicU64::new(0),
            moved_looks: AtomicU32::new(0),
        }
    }
}

impl Progress for LetsGo<'_> {
    fn is_cancelled(&self) -> bool {
        let depth_mm = depth_mm(self.world);
        let looks = self.looks.load(Ordering::SeqCst);
        if looks == 0 && depth_mm < 0.3 || looks > LOOKS {
            return false;
        }
        match self.looks.fetch_add(1, Ordering::SeqCst) {
            0 => self.world.state().is_held = false,
            HALTED_LOOKS => self.stood.store(depth_mm.to_bits(), Ordering::SeqCst),
            LOOKS => self.world.state().is_held = true,
            later if later > HALTED_LOOKS => {
                let stood_mm = f64::from_bits(self.stood.load(Ordering::SeqCst));
                let has_moved = (depth_mm - stood_mm).abs() > 1e-9;
                self.moved_looks
                    .fetch_add(u32::from(has_moved), Ordering::SeqCst);
            }
            _ => {}
        }
        false
    }
}

#[test]
fn a_switch_that_is_let_go_in_the_gel_halts_the_tip_there_and_the_press_is_made_again_once_it_is_held()
 {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let lets_go = LetsGo::new(&world);
    let dataset = recorded(&world, folder.path(), &lets_go);
    assert_whole(&dataset.expect("it was held again"));
    assert_eq!(lets_go.looks.load(Ordering::SeqCst), LOOKS + 1);
    let stood_mm = f64::from_bits(lets_go.stood.load(Ordering::SeqCst));
    assert!(stood_mm > 0.2, "it stood in the gel: {stood_mm} mm");
    assert_eq!(lets_go.moved_looks.load(Ordering::SeqCst), 0);
    assert!(world.state().halts > 0);
}

#[test]
fn a_switch_that_nobody_holds_lets_nothing_move_and_the_run_ends_when_the_patience_does() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    world.state().is_held = false;
    let error = stopped(recorded(&world, folder.path(), &SilentProgress));
    assert!(matches!(error.cause, StopCause::Unheld { .. }), "{error}");
    let said = error.to_string();
    assert!(
        said.starts_with("the enabling switch was not held within 1 s: hold it"),
        "{said}"
    );
    assert_eq!(world.state().motions, 0);
    world.state().is_held = true;
    assert_whole(&recorded(&world, folder.path(), &SilentProgress).expect("it is held"));
}

/// Progress receiver that unplugs the enabling switch when the tip is deep in the gel.
struct Unplugs<'a>(&'a World);

impl Progress for Unplugs<'_> {
    fn is_cancelled(&self) -> bool {
        if depth_mm(self.0) > 0.3 {
            self.0.state().is_unplugged = true;
        }
        false
    }
}

#[test]
fn a_switch_that_is_unplugged_leaves_the_tip_where_it_is_and_the_run_goes_on_with_it_later() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let error = stopped(recorded(&world, folder.path(), &Unplugs(&world)));
    let lost = StopCause::Tripped(Trip::SwitchLost);
    assert_eq!(error.cause.to_string(), lost.to_string());
    assert_eq!(error.left, Left::InPlace);
    assert!(world.state().is_halted && depth_mm(&world) > 0.2);
    world.state().is_unplugged = false;
    assert_whole(&recorded(&world, folder.path(), &SilentProgress).expect("it is there"));
}

#[test]
fn an_enable_that_is_no_switch_or_does_not_open_is_refused_with_its_line_before_anything_is_opened()
{
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    world.state().is_unplugged = true;
    for (enable, line) in [
        (
            "wall/robot",
            "`wall/robot` is not an enabling switch, expected `wall/pedal`",
        ),
        ("wall/pedal:usb=1", "`usb`"),
        (
            "wall/pedal",
            "it was unplugged; plug the switch in and check that this user may read it",
        ),
    ] {
        let rig = rig_with(folder.path(), enable);
        let person = Mutex::new(Person::default());
        let run = folder.path().join("run");
        let refused = record_on(
            &world,
            &run,
            &SilentProgress,
            (&scene(), Some(&rig), Some(&person)),
        );
        let said = refused.expect_err("nothing to hold").to_string();
        assert!(
            said.contains("lab.toml, line 13: `enable`: ") && said.contains(line),
            "{said}"
        );
        let state = world.state();
        assert_eq!((state.readings, state.motions), (0, 0));
    }
}

/// Test operator who allows the robot to move.
struct LetsMove;

impl Operator for LetsMove {
    fn ask(&mut self, _: &Question, _: &Cancel) -> Answer {
        Answer::Done
    }
}

/// Result of `rig check` on the emulated rig, with an operator. The switch is held if `is_held` is true.
fn checked(world: &World, is_held: bool) -> RigCheck {
    let folder = tempfile::tempdir().expect("a folder");
    let rig = read_rig(&rig_with(folder.path(), "wall/pedal")).expect("a rig");
    world.state().is_held = is_held;
    check_rig(&rig, &drivers(world), Some(&mut LetsMove)).expect("devices that answer")
}

#[test]
fn a_check_of_the_rig_looks_at_the_switch_and_moves_the_robot_only_while_it_is_held() {
    let world = World::new();
    let found = checked(&world, true);
    let switch = found.switch.expect("it is in the file");
    assert_eq!((switch.looks, switch.changes), (switch.held, 0));
    assert!(switch.looks > 3 && switch.longest_ms < 1e3, "{switch:?}");
    assert!(found.halt.is_some() && world.state().motions == 1);
    let world = World::new();
    let found = checked(&world, false);
    let switch = found.switch.expect("it is in the file");
    assert_eq!(switch.held, 0, "{switch:?}");
    assert!(found.halt.is_none() && world.state().motions == 0);
    assert!(
        found.problems.contains(&RigProblem::Unheld),
        "{:?}",
        found.problems
    );
}

#[test]
fn a_check_of_a_rig_whose_switch_does_not_open_measures_the_other_devices_and_moves_nothing() {
    let world = World::new();
    world.state().is_unplugged = true;
    let found = checked(&world, true);
    let failed = found.problems.iter().filter(|problem| problem.is_failure());
    let failed: Vec<&RigProblem> = failed.collect();
    let [RigProblem::Failed { device, why }] = failed[..] else {
        panic!("{failed:?}");
    };
    assert_eq!(*device, "switch");
    assert!(why.contains("plug the switch in"), "{why}");
    assert!(found.force.is_some() && found.robot.is_some() && found.sensor.is_some());
    assert!(found.halt.is_none() && world.state().motions == 0);
    let left_out = found.halt_left_out.expect("a reason");
    assert_eq!(
        left_out,
        "nothing moves, because the enabling switch failed"
    );
}
