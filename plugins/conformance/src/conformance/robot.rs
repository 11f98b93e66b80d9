//! The suite for robots.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Instant;

use taceva_core::{
    Deadline, DriverError, ErrorKind, Factory, Guard, Millimetre, Newton, Pose, Robot, RobotFacts,
    Speed,
};

use super::bench::{Bench, Test, Unmet, broken, expect, in_order, refused, run};
use super::{Report, Trial};
use taceva_core::contained;

/// Tries a robot, which moves.
pub fn robot(factory: &dyn Factory<dyn Robot>, trial: &Trial) -> Report {
    run(factory, trial, TESTS)
}

type Subject<'a> = Bench<'a, dyn Robot>;

const TESTS: &[Test<dyn Robot>] = &[
    (
        "stands in its workspace, and stays while nobody moves it",
        stands_still,
    ),
    ("arrives where it is sent, and comes back", arrives),
    (
        "refuses a pose that is not finite, and stays",
        refuses_not_finite,
    ),
    (
        "refuses a pose outside its workspace, and stays",
        refuses_outside,
    ),
    (
        "refuses a speed above its greatest, and stays",
        refuses_too_fast,
    ),
    (
        "gives up a motion it has no time for, and stands",
        keeps_deadlines,
    ),
    ("latches a halt until it is cleared", latches_halt),
    (
        "stops at a halt from another thread",
        halts_from_another_thread,
    ),
    (
        "leaves a halt handle that outlives it harmless",
        handle_outlives,
    ),
    (
        "guards its motion if it declares that it can",
        guards_as_declared,
    ),
];

fn stands_still(bench: &Subject<'_>) -> Result<(), Unmet> {
    let mut robot = bench.open()?;
    let (first, earlier) = robot.pose(bench.trial.deadline)?;
    let (second, later) = robot.pose(bench.trial.deadline)?;
    in_order(&[earlier])?;
    in_order(&[later])?;
    expect(earlier.valid_s <= later.valid_s, || {
        "time went back".to_owned()
    })?;
    near(bench, &second, &first)?;
    match facts(bench)?.workspace {
        Some(workspace) => expect(workspace.contains(&first.position), || {
            format!("stands at {:?}, outside its workspace", first.position)
        }),
        None => Ok(()),
    }
}

fn arrives(bench: &Subject<'_>) -> Result<(), Unmet> {
    let mut robot = bench.open()?;
    let course = Course::of(bench, robot.as_mut())?;
    let there = robot.move_to(course.away, course.speed, bench.trial.deadline)?;
    let (pose, _) = robot.pose(bench.trial.deadline)?;
    near(bench, &pose, &course.away)?;
    let back = robot.move_to(course.home, course.speed, bench.trial.deadline)?;
    let (pose, _) = robot.pose(bench.trial.deadline)?;
    near(bench, &pose, &course.home)?;
    in_order(&[there, back])
}

fn refuses_not_finite(bench: &Subject<'_>) -> Result<(), Unmet> {
    let mut robot = bench.open()?;
    let course = Course::of(bench, robot.as_mut())?;
    let spoil: [fn(&mut Pose, f64); 6] = [
        |pose, value| pose.position.x.0 = value,
        |pose, value| pose.position.y.0 = value,
        |pose, value| pose.position.z.0 = value,
        |pose, value| pose.rotation.x.0 = value,
        |pose, value| pose.rotation.y.0 = value,
        |pose, value| pose.rotation.z.0 = value,
    ];
    for spoil in spoil {
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let mut target = course.away;
            spoil(&mut target, value);
            let moved = robot.move_to(target, course.speed, bench.trial.deadline);
            refused(
                &format!("moving to {target:?}"),
                moved,
                &[ErrorKind::InvalidArgument],
            )?;
        }
    }
    course.still_home(bench, robot.as_mut())
}

fn refuses_outside(bench: &Subject<'_>) -> Result<(), Unmet> {
    let Some(workspace) = facts(bench)?.workspace else {
        return Err(Unmet::Inapplicable("it declares no workspace".to_owned()));
    };
    let mut robot = bench.open()?;
    let course = Course::of(bench, robot.as_mut())?;
    let mut beyond = course.home;
    beyond.position.x.0 = workspace.greatest.x.0 + 1.0;
    let mut below = course.home;
    below.position.y.0 = workspace.least.y.0 - 1.0;
    for target in [beyond, below] {
        let moved = robot.move_to(target, course.speed, bench.trial.deadline);
        refused(
            "moving out of the workspace",
            moved,
            &[ErrorKind::OutOfRange],
        )?;
    }
    course.still_home(bench, robot.as_mut())
}

fn refuses_too_fast(bench: &Subject<'_>) -> Result<(), Unmet> {
    let Some(greatest) = facts(bench)?.speed_max else {
        return Err(Unmet::Inapplicable(
            "it declares no greatest speed".to_owned(),
        ));
    };
    let mut robot = bench.open()?;
    let course = Course::of(bench, robot.as_mut())?;
    let too_fast = speed(2.0 * greatest.mm_per_s())?;
    let moved = robot.move_to(course.away, too_fast, bench.trial.deadline);
    refused(
        "moving twice as fast as it can",
        moved,
        &[ErrorKind::OutOfRange],
    )?;
    course.still_home(bench, robot.as_mut())
}

fn keeps_deadlines(bench: &Subject<'_>) -> Result<(), Unmet> {
    let mut robot = bench.open()?;
    let course = Course::of(bench, robot.as_mut())?;
    let moved = bench.at_once("moving without time", || {
        robot.move_to(course.away, course.speed, Deadline::PASSED)
    })?;
    refused("moving without time", moved, &[ErrorKind::Timeout])?;
    let (first, _) = robot.pose(bench.trial.deadline)?;
    let (second, _) = robot.pose(bench.trial.deadline)?;
    near(bench, &second, &first)?;
    // A motion that was given up is no halt: the next one is accepted.
    robot.move_to(course.home, course.speed, bench.trial.deadline)?;
    course.still_home(bench, robot.as_mut())
}

fn latches_halt(bench: &Subject<'_>) -> Result<(), Unmet> {
    let deadline = bench.trial.deadline;
    let mut robot = bench.open()?;
    let course = Course::of(bench, robot.as_mut())?;
    robot.clear_halt(deadline)?;
    for _ in 0..2 {
        bench.at_once("halting", || robot.halt())??;
    }
    for _ in 0..2 {
        let moved = robot.move_to(course.away, course.speed, deadline);
        // A halt that was asked for is acknowledged by nobody; a fault would be.
        let fault = moved.as_ref().err().and_then(DriverError::fault);
        expect(fault.is_none(), || {
            "moving after a halt names a fault, expected one of the device alone".to_owned()
        })?;
        refused("moving after a halt", moved, &[ErrorKind::Interrupted])?;
    }
    course.still_home(bench, robot.as_mut())?;
    robot.clear_halt(deadline)?;
    course.still_home(bench, robot.as_mut())?;
    robot.move_to(course.away, course.speed, deadline)?;
    robot.move_to(course.home, course.speed, deadline)?;
    course.still_home(bench, robot.as_mut())
}

fn halts_from_another_thread(bench: &Subject<'_>) -> Result<(), Unmet> {
    let deadline = bench.trial.deadline;
    let mut robot = bench.open()?;
    let course = Course::of(bench, robot.as_mut())?;
    let handle = robot.halt_handle();
    let moving = AtomicBool::new(false);
    // Set once the halt has returned: when it was called, and what it gave.
    let halted = OnceLock::new();
    let moved = thread::scope(|scope| {
        scope.spawn(|| {
            while !moving.load(Ordering::Acquire) {
                thread::yield_now();
            }
            let called = Instant::now();
            let result = contained(|| handle.halt().map_err(Unmet::from));
            let _ = halted.set((called, result.unwrap_or_else(|panic| Err(broken(panic)))));
        });
        moving.store(true, Ordering::Release);
        let mut targets = [course.away, course.home].into_iter().cycle();
        loop {
            let already_halted = halted.get().is_some();
            let target = targets.next().unwrap_or(course.home);
            match robot.move_to(target, course.speed, deadline) {
                Ok(_) if already_halted => break Ok(()),
                Ok(_) => {}
                Err(error) => break Err((error, Instant::now())),
            }
        }
    });
    let (called, result) = halted
        .into_inner()
        .ok_or_else(|| broken("the halt did not return"))?;
    result?;
    match moved {
        Ok(_) => return Err(broken("accepted a motion after it was halted")),
        Err((error, returned)) => {
            refused(
                "moving while it was halted",
                Err::<(), _>(error),
                &[ErrorKind::Interrupted],
            )?;
            bench.was_at_once("stopping", returned.saturating_duration_since(called))?;
        }
    }
    let (first, _) = robot.pose(deadline)?;
    let (second, _) = robot.pose(deadline)?;
    near(bench, &second, &first)?;
    robot.clear_halt(deadline)?;
    robot.move_to(course.home, course.speed, deadline)?;
    course.still_home(bench, robot.as_mut())
}

fn handle_outlives(bench: &Subject<'_>) -> Result<(), Unmet> {
    let robot = bench.open()?;
    let handle = robot.halt_handle();
    drop(robot);
    bench.at_once("halting a robot that is gone", || handle.halt())??;
    // Another robot is not stopped by the handle of one that is gone.
    let mut next = bench.open()?;
    let course = Course::of(bench, next.as_mut())?;
    next.move_to(course.home, course.speed, bench.trial.deadline)?;
    Ok(())
}

fn guards_as_declared(bench: &Subject<'_>) -> Result<(), Unmet> {
    let declared = facts(bench)?.guarded_motion;
    let mut robot = bench.open()?;
    let course = Course::of(bench, robot.as_mut())?;
    match (robot.guarded_motion(), declared) {
        (None, false) => return Err(Unmet::Inapplicable("it cannot".to_owned())),
        (None, true) => return Err(broken("cannot, yet declares it")),
        (Some(_), false) => return Err(broken("can, yet does not declare it")),
        (Some(guarded), true) => {
            for force in [f64::NAN, 0.0, -1.0] {
                let guard = Guard::at(Newton(force));
                let moved =
                    guarded.move_guarded(course.away, course.speed, guard, bench.trial.deadline);
                let doing = format!("moving with a guard of {force} N");
                refused(&doing, moved, &[ErrorKind::InvalidArgument])?;
            }
        }
    }
    course.still_home(bench, robot.as_mut())
}

/// A short way out of the gel, and how fast.
struct Course {
    home: Pose,
    away: Pose,
    speed: Speed,
}

/// How fast a trial moves, where the robot can, in mm/s.
const UNHURRIED: f64 = 5.0;

impl Course {
    fn of(bench: &Subject<'_>, robot: &mut dyn Robot) -> Result<Course, Unmet> {
        let facts = facts(bench)?;
        let (home, _) = robot.pose(bench.trial.deadline)?;
        let mut away = home;
        away.position.z = Millimetre(home.position.z.0 - bench.trial.travel.0);
        if let Some(workspace) = facts
            .workspace
            .filter(|workspace| !workspace.contains(&away.position))
        {
            return Err(broken(format!(
                "{} of travel away from {:?} leaves the workspace down to {:?}",
                bench.trial.travel, home.position, workspace.least
            )));
        }
        let greatest = facts.speed_max.map_or(UNHURRIED, Speed::mm_per_s);
        Ok(Course {
            home,
            away,
            speed: speed(greatest.min(UNHURRIED))?,
        })
    }

    /// Breaks off unless the robot stands where it stood.
    fn still_home(&self, bench: &Subject<'_>, robot: &mut dyn Robot) -> Result<(), Unmet> {
        near(bench, &robot.pose(bench.trial.deadline)?.0, &self.home)
    }
}

fn speed(mm_per_s: f64) -> Result<Speed, Unmet> {
    Speed::try_new(mm_per_s).map_err(|error| broken(error.to_string()))
}

fn facts<'a>(bench: &'a Subject<'_>) -> Result<&'a RobotFacts, Unmet> {
    let facts = bench.descriptor.robot();
    facts.ok_or_else(|| broken("does not declare itself a robot"))
}

/// Breaks off unless the two are as near as the robot repeats itself: six standard deviations of a difference, or 0.1 mm.
fn near(bench: &Subject<'_>, found: &Pose, expected: &Pose) -> Result<(), Unmet> {
    const UNKNOWN_MM: f64 = 0.1;
    const ROUNDING_MM: f64 = 1e-6;
    let spread = facts(bench)?.repeatability;
    let tolerance_mm = spread.map_or(UNKNOWN_MM, |spread| {
        6.0 * std::f64::consts::SQRT_2 * spread.0 + ROUNDING_MM
    });
    let (found, expected) = (found.position, expected.position);
    let differences = [
        found.x.0 - expected.x.0,
        found.y.0 - expected.y.0,
        found.z.0 - expected.z.0,
    ];
    let is_near = differences
        .iter()
        .all(|difference| difference.abs() <= tolerance_mm);
    expect(is_near, || {
        format!("stands at {found:?}, expected {expected:?} within {tolerance_mm} mm")
    })
}
