//! Tests of the setup of a rig: readings of devices, the halt of the robot, and taught places.

use std::path::{Path, PathBuf};
use std::sync::Mutex;

use taceva_acquire::{AcquireError, RigProblem, check_rig, read_rig, teach_rig};
use taceva_core::{ErrorKind, SilentProgress};
use taceva_protocol::{Answer, Cancel, Operator, Question, RigFile, Spot};

use crate::waiting::devices::drivers;
use crate::waiting::record_on;
use crate::waiting::session::{self, UPRIGHT, rig_file, scene};
use crate::waiting::world::World;

/// Test operator who always gives one answer to the request to move the robot.
struct Person(Answer);

impl Operator for Person {
    fn ask(&mut self, question: &Question, _: &Cancel) -> Answer {
        let said = question.to_string();
        let way = "`wall/robot` is about to move: 5 mm straight up at 5 mm/s, halted on the way;";
        assert!(said.starts_with(way), "{said}");
        self.0
    }
}

fn rig() -> RigFile {
    let folder = tempfile::tempdir().expect("a folder");
    read_rig(&rig_file(folder.path(), UPRIGHT)).expect("a rig")
}

#[test]
fn a_check_hears_every_device_and_halts_the_robot_once_on_its_way_up_if_somebody_lets_it() {
    let world = World::new();
    let drivers = drivers(&world);
    let before_mm = world.state().tip(taceva_drivers::MonotonicClock.now_s())[2];
    let unmoved = check_rig(&rig(), &drivers, Some(&mut Person(Answer::Stop)));
    let unmoved = unmoved.expect("devices that answer");
    assert!(unmoved.halt.is_none() && world.state().motions == 0);
    let check = check_rig(&rig(), &drivers, Some(&mut Person(Answer::Done)));
    let check = check.expect("devices that answer");
    let force = check.force.expect("it is in the file");
    // A reading every 5 ms, fewer on a busy machine, with noise of 1 mN.
    assert!((20.0..201.0).contains(&force.rate_hz), "{force:?}");
    let noise_n = force.noise.expect("numbers");
    assert!((0.0009..0.0011).contains(&noise_n), "{force:?}");
    assert!(check.sensor.is_some_and(|sensor| sensor.count > 0));
    let robot = check.robot.expect("it is in the file");
    assert!(
        robot.count > 10 && robot.noise.is_some_and(|noise_mm| noise_mm < 1e-9),
        "{robot:?}"
    );
    let halt = check.halt.expect("somebody let it move");
    // 0.3 s upwards at 5 mm/s, or a little more on a busy machine.
    assert!((1.0..4.9).contains(&halt.left_mm), "{halt:?}");
    let now_s = taceva_drivers::MonotonicClock.now_s();
    let state = world.state();
    assert!(state.is_halted && state.tip(now_s)[2] < before_mm - 1.0);
}

#[test]
fn a_transducer_that_says_nothing_is_a_problem_with_what_helps() {
    let world = World::new();
    world.state().withheld = u32::MAX;
    let check = check_rig(&rig(), &drivers(&world), None).expect("the others answer");
    let [RigProblem::Unheard { device: "force" }] = check.problems[..] else {
        panic!("{:?}", check.problems);
    };
    assert!(check.problems[0].to_string().contains("check its cable"));
}

#[test]
fn a_camera_that_fails_is_named_and_the_other_devices_are_measured_and_the_robot_is_halted() {
    let world = World::new();
    world.state().camera = Some(ErrorKind::Disconnected);
    let check = check_rig(&rig(), &drivers(&world), Some(&mut Person(Answer::Done)));
    let check = check.expect("the file is right");
    let failed = check.problems.iter().filter(|problem| problem.is_failure());
    let failed: Vec<_> = failed.filter_map(RigProblem::device).collect();
    assert_eq!(failed, ["sensor"], "{:?}", check.problems);
    let mut failed = check.problems.iter().filter(|problem| problem.is_failure());
    let said = failed.next().map(ToString::to_string).unwrap_or_default();
    assert!(
        said.starts_with("wall/gel: cannot take a picture: ") && said.contains("; check its cable"),
        "{said}"
    );
    assert!(check.force.is_some() && check.robot.is_some() && check.sensor.is_none());
    assert!(check.halt.is_some() && check.halt_left_out.is_none());
}

#[test]
fn nothing_moves_in_a_check_whose_force_or_robot_failed_and_nobody_is_asked_to_permit_it() {
    for (withheld, is_lost, why) in [
        (u32::MAX, false, "because the force transducer failed"),
        (0, true, "because the robot failed"),
        (
            u32::MAX,
            true,
            "because the robot and the force transducer failed",
        ),
    ] {
        let world = World::new();
        world.state().withheld = withheld;
        world.state().is_lost = is_lost;
        let check = check_rig(&rig(), &drivers(&world), Some(&mut Nobody));
        let check = check.expect("the file is right");
        assert!(check.sensor.is_some_and(|sensor| sensor.count > 0));
        assert_eq!(check.robot.is_some(), !is_lost);
        assert!(check.halt.is_none() && world.state().motions == 0);
        let left_out = check.halt_left_out.expect("a reason");
        assert_eq!(left_out, format!("nothing moves, {why}"));
    }
}

#[test]
fn nothing_moves_in_a_check_whose_rig_file_has_the_tip_in_the_gel_or_was_never_taught() {
    let world = World::new();
    assert!(world.travel([0.0, 0.0, 0.25], 50.0));
    let check = check_rig(&rig(), &drivers(&world), Some(&mut Nobody)).expect("a file");
    let is_deep = |problem: &RigProblem| match problem {
        RigProblem::InGel { depth_mm } => (depth_mm - 0.25).abs() < 1e-9,
        _ => false,
    };
    assert!(check.problems.iter().any(is_deep), "{:?}", check.problems);
    assert!(check.halt.is_none() && world.state().motions == 1);
    let world = World::new();
    let check = check_rig(&untaught(), &drivers(&world), Some(&mut Nobody)).expect("a file");
    assert!(check.problems.contains(&RigProblem::Untaught));
    assert!(check.halt.is_none() && world.state().motions == 0);
    let why = "nothing moves, because `origin_mm` or `axes` of the robot are wrong";
    assert_eq!(check.halt_left_out.as_deref(), Some(why));
}

/// Operator who jogs the tip into the gel before allowing the robot to move.
struct JogsIntoGel(World);

impl Operator for JogsIntoGel {
    fn ask(&mut self, _: &Question, _: &Cancel) -> Answer {
        assert!(self.0.travel([0.0, 0.0, 0.25], 50.0));
        Answer::Done
    }
}

#[test]
fn nothing_moves_in_a_check_if_the_tip_was_jogged_into_the_gel_before_somebody_let_it_move() {
    let world = World::new();
    let mut jogs = JogsIntoGel(world.clone());
    let check = check_rig(&rig(), &drivers(&world), Some(&mut jogs)).expect("a file");
    let mut problems = check.problems.iter();
    let is_deep = problems.any(|problem| matches!(problem, RigProblem::InGel { .. }));
    assert!(is_deep, "{:?}", check.problems);
    assert!(check.halt.is_none() && world.state().motions == 1);
    let why = "nothing moves, because `origin_mm` or `axes` of the robot are wrong";
    assert_eq!(check.halt_left_out.as_deref(), Some(why));
}

/// Rig file with the values of a new file, which `init rig` writes.
fn untaught() -> RigFile {
    let folder = tempfile::tempdir().expect("a folder");
    read_rig(&new_file(folder.path())).expect("a rig")
}

fn new_file(folder: &Path) -> PathBuf {
    let path = rig_file(folder, UPRIGHT);
    let text = std::fs::read_to_string(&path).expect("written");
    std::fs::write(&path, text.replace("wall/robot", "wall/arm")).expect("written");
    path
}

#[test]
fn a_run_with_a_rig_file_that_was_never_taught_is_refused_with_its_line_before_anything_is_opened()
{
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    world.state().is_lost = true;
    let rig = new_file(folder.path());
    let person = Mutex::new(session::Person::default());
    let refused = record_on(
        &world,
        &folder.path().join("run"),
        &SilentProgress,
        (&scene(), Some(&rig), Some(&person)),
    );
    let said = refused.expect_err("never taught").to_string();
    assert!(
        said.contains(
            "lab.toml, line 5: `origin_mm` and `axes` still have the values of a new file: run taceva rig teach"
        ),
        "{said}"
    );
    let state = world.state();
    assert_eq!((state.readings, state.motions), (0, 0));
}

/// Test operator for whom any question fails the test.
struct Nobody;

impl Operator for Nobody {
    fn ask(&mut self, question: &Question, _: &Cancel) -> Answer {
        panic!("{question}");
    }
}

/// Test operator who jogs the robot to three given places in the base frame.
struct Jogs {
    world: World,
    along: [[f64; 3]; 3],
}

impl Operator for Jogs {
    fn ask(&mut self, question: &Question, _: &Cancel) -> Answer {
        let Question::Jog(spot) = question else {
            panic!("{question}");
        };
        let place = match spot {
            Spot::Middle => self.along[0],
            Spot::AlongX => self.along[1],
            Spot::AlongY => self.along[2],
        };
        assert!(self.world.travel(place, 1e5));
        Answer::Done
    }
}

#[test]
fn three_places_to_which_the_robot_is_jogged_become_its_origin_and_axes() {
    let world = World::new();
    let mut jogs = Jogs {
        world: world.clone(),
        along: [
            [300.0, 5.0, 251.25],
            [300.1, 13.0, 251.5],
            [308.0, 5.2, 251.25],
        ],
    };
    let (taught, text) = teach_rig(&rig(), &drivers(&world), &mut jogs).expect("a frame");
    assert!(taught.origin_mm.iter().eq(&[300.0, 5.0, 251.25]));
    let rig = RigFile::parse("lab.toml", &text).expect("it is a rig file still");
    let robot = rig.robot.expect("a robot");
    assert_eq!(robot.axes.value.to_string(), "[\"y\", \"x\", \"-z\"]");
    assert!(robot.origin_mm.value.iter().eq(&taught.origin_mm));
    assert_eq!(rig.force, self::rig().force);
    // Only the operator moved it.
    assert_eq!(world.state().motions, 3);
}

#[test]
fn places_that_are_no_frame_are_refused_with_the_line_of_the_axes() {
    let world = World::new();
    let mut jogs = Jogs {
        world: world.clone(),
        along: [
            [300.0, 5.0, 251.25],
            [305.0, 9.0, 251.25],
            [308.0, 5.0, 251.25],
        ],
    };
    let refused = teach_rig(&rig(), &drivers(&world), &mut jogs).expect_err("askew");
    let said = refused.to_string();
    assert!(matches!(refused, AcquireError::Scene(_)), "{said}");
    assert!(
        said.contains("lab.toml, line 6: the jog along x ends 4.00 mm off"),
        "{said}"
    );
}

#[test]
fn a_jog_along_x_that_is_too_short_is_refused_before_the_jog_along_y() {
    let world = World::new();
    let middle = [300.0, 5.0, 251.25];
    let mut jogs = Jogs {
        world: world.clone(),
        along: [middle, middle, [308.0, 5.0, 251.25]],
    };
    let refused = teach_rig(&rig(), &drivers(&world), &mut jogs).expect_err("no jog");
    let said = refused.to_string();
    assert!(said.contains("the jog along x is 0.00 mm long"), "{said}");
    assert_eq!(world.state().motions, 2);
}
