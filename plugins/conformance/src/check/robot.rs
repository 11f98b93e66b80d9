//! Checks of robots. Those that move one are made on simulations alone, unless the user allows it.

mod bare;

use std::thread;
use std::time::{Duration, Instant};

use taceva_abi as abi;
use taceva_core::{
    Deadline, DriverError, DriverKind, ErrorKind, Guard, Millimetre, Newton, Pose, Robot,
    RobotFacts, Speed,
};

use self::bare::{Bare, bare_move, bare_pose, no_speeds, no_targets, outside, wait_without};
use super::subject::{AT_ONCE, Ending, PATIENT, SOON, Subject, ensure, expect_failure, timed};
use super::{Check, Of};
use taceva_host::Session;

pub(super) const CHECKS: &[Check] = &[
    check("robot/says-its-pose", poses),
    check("robot/moves-and-arrives", moves),
    check("robot/refuses-targets-that-are-none", no_targets),
    check("robot/refuses-speeds-that-are-none", no_speeds),
    check("robot/refuses-what-lies-outside", outside),
    check("robot/wait-without-a-motion", wait_without),
    check("robot/halts-twice-and-latches", latches),
    check("robot/halt-within-50-ms", halts),
    check("robot/timeout-stops-it", timeout_stops),
    check("robot/halt-from-all-sides", halt_from_all_sides),
    check("robot/guards-that-are-none", no_guards),
    check("robot/dropped-in-any-state", dropped),
];

const fn check(name: &'static str, run: fn(&Subject) -> Result<(), Ending>) -> Check {
    Check {
        name,
        of: Of::Kind(DriverKind::Robot),
        run,
    }
}

fn open(subject: &Subject) -> Result<Box<dyn Robot>, Ending> {
    subject.opened(subject.session.robot(subject.key()?, &subject.args()?))
}

fn facts(subject: &Subject) -> Result<RobotFacts, Ending> {
    let said = subject.said()?;
    let facts = said.robot().copied();
    facts.ok_or_else(|| Ending::Broken("it says it is no robot".to_owned()))
}

/// The pose `travel_mm` above `pose`: away from the gel.
fn above(mut pose: Pose, travel_mm: f64) -> Pose {
    pose.position.z = Millimetre(pose.position.z.0 - travel_mm);
    pose
}

fn speed(mm_per_s: f64) -> Result<Speed, Ending> {
    Speed::try_new(mm_per_s).map_err(|error| Ending::Broken(error.to_string()))
}

fn here(robot: &mut dyn Robot) -> Result<Pose, Ending> {
    Ok(robot.pose(PATIENT)?.0)
}

fn poses(subject: &Subject) -> Result<(), Ending> {
    let mut robot = open(subject)?;
    let mut last = f64::NEG_INFINITY;
    for _ in 0..20 {
        let (_, stamp) = robot.pose(PATIENT)?;
        ensure(stamp.valid_s >= last, || {
            "a pose older than the one before".to_owned()
        })?;
        last = stamp.valid_s;
    }
    let (_, took) = timed(|| robot.pose(Deadline::PASSED));
    ensure(took < SOON, || {
        format!("no time was given, and it took {took:?}")
    })
}

fn moves(subject: &Subject) -> Result<(), Ending> {
    subject.may_move()?;
    let mut robot = open(subject)?;
    let home = here(&mut *robot)?;
    for target in [above(home, 0.5), home] {
        robot.move_to(target, speed(5.0)?, PATIENT)?;
        let reached = here(&mut *robot)?;
        let off = (reached.position.z.0 - target.position.z.0).abs();
        ensure(off < 0.1, || format!("it rests {off} mm beside its target"))?;
    }
    Ok(())
}

fn latches(subject: &Subject) -> Result<(), Ending> {
    subject.may_move()?;
    let mut robot = open(subject)?;
    let home = here(&mut *robot)?;
    robot.halt()?;
    robot.halt()?;
    let answer = robot.move_to(above(home, 0.1), speed(5.0)?, PATIENT);
    let fault = answer.as_ref().err().and_then(DriverError::fault);
    ensure(fault.is_none(), || {
        "a move after a halt names a fault, expected one of the device alone".to_owned()
    })?;
    expect_failure("a move after a halt", answer, &[ErrorKind::Interrupted])?;
    here(&mut *robot)?;
    robot.clear_halt(PATIENT)?;
    robot.clear_halt(PATIENT)?;
    robot.move_to(above(home, 0.1), speed(5.0)?, PATIENT)?;
    robot.move_to(home, speed(5.0)?, PATIENT)?;
    Ok(())
}

fn halts(subject: &Subject) -> Result<(), Ending> {
    subject.may_move()?;
    let mut robot = open(subject)?;
    let home = here(&mut *robot)?;
    let halt = robot.halt_handle();
    let halter = thread::spawn(move || {
        thread::sleep(Duration::from_millis(20));
        let now = Instant::now();
        (
            now,
            halt.halt().map_err(|error| error.to_string()),
            now.elapsed(),
        )
    });
    // Slow: a simulation counts its own time, and may be there before the halt is.
    let answer = robot.move_to(
        above(home, 1.0),
        speed(0.01)?,
        Deadline::after(Duration::from_secs(200)),
    );
    let ended = Instant::now();
    let (at, sent, took) = halter
        .join()
        .map_err(|_| Ending::Broken("the check panicked".to_owned()))?;
    sent.map_err(Ending::Broken)?;
    ensure(took < AT_ONCE, || format!("`halt` itself took {took:?}"))?;
    if answer.is_err() {
        expect_failure("a move that was halted", answer, &[ErrorKind::Interrupted])?;
        let late = ended.saturating_duration_since(at);
        ensure(late < AT_ONCE, || {
            format!("it took {late:?}, expected at most {AT_ONCE:?}")
        })?;
    }
    robot.clear_halt(PATIENT)?;
    robot.move_to(home, speed(5.0)?, PATIENT)?;
    Ok(())
}

fn timeout_stops(subject: &Subject) -> Result<(), Ending> {
    subject.may_move()?;
    let mut robot = open(subject)?;
    let home = here(&mut *robot)?;
    let short = Deadline::after(Duration::from_millis(20));
    let answer = robot.move_to(above(home, 1.0), speed(1.0)?, short);
    expect_failure("a move of 1 s in 20 ms", answer, &[ErrorKind::Timeout])?;
    let once = here(&mut *robot)?;
    thread::sleep(Duration::from_millis(50));
    let again = here(&mut *robot)?;
    let off = (again.position.z.0 - once.position.z.0).abs();
    ensure(off < 0.02, || {
        format!("after the timeout it went on by {off} mm")
    })?;
    robot.move_to(home, speed(5.0)?, PATIENT)?;
    Ok(())
}

fn halt_from_all_sides(subject: &Subject) -> Result<(), Ending> {
    let mut robot = open(subject)?;
    let halt = robot.halt_handle();
    let failed = thread::scope(|scope| {
        let halters: Vec<_> = (0..4)
            .map(|_| {
                let halt = &halt;
                scope.spawn(move || (0..500).filter(|_| halt.halt().is_err()).count())
            })
            .collect();
        halters
            .into_iter()
            .map(|halter| halter.join().unwrap_or(1))
            .sum::<usize>()
    });
    ensure(failed == 0, || format!("{failed} of 2000 halts failed"))?;
    robot.clear_halt(PATIENT)?;
    drop(robot);
    Ok(halt.halt()?)
}

fn no_guards(subject: &Subject) -> Result<(), Ending> {
    let mut robot = open(subject)?;
    let home = here(&mut *robot)?;
    let Some(guarded) = robot.guarded_motion() else {
        return Err(Ending::Skipped(
            "it does not stop by itself at a force".to_owned(),
        ));
    };
    for force in [0.0, -1.0, f64::NAN] {
        let guard = Guard::at(Newton(force));
        let answer = guarded.move_guarded(home, speed(1.0)?, guard, PATIENT);
        expect_failure(
            &format!("a guard of {force} N"),
            answer,
            &[ErrorKind::InvalidArgument],
        )?;
    }
    Ok(())
}

fn dropped(subject: &Subject) -> Result<(), Ending> {
    drop(open(subject)?);
    let mut robot = open(subject)?;
    robot.halt()?;
    drop(robot);
    let pose = bare_pose(subject)?;
    if subject.may_move().is_ok() {
        let robot: Bare = subject.open()?;
        let target = abi::Pose {
            z: pose.z - 1e-4,
            ..pose
        };
        bare_move(&robot, target, 0.001)?;
        drop(robot);
    }
    drop(open(subject)?);
    Ok(())
}
