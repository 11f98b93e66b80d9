//! Promises of robots. Tests with motions move the robot by [`Trial::travel`] away from the gel and back. No test presses the gel.

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::{Duration, Instant};

use taceva_core::{
    Deadline, DriverError, ErrorKind, Factory, Guard, Millimetre, Newton, Pose, Robot, RobotFacts,
    Speed, contained,
};

use crate::promise::{Unmet, broken, expect, in_order, refused, skipped};
use crate::report::Report;
use crate::stream::as_declared;
use crate::trial::{Promise, Trial, Tried, report, was_within};

/// Tests the promises of a robot with the settings of `trial`. The robot moves if `trial` allows motions.
pub fn robot(factory: &dyn Factory<dyn Robot>, trial: &Trial) -> Report {
    report(factory, trial, PROMISES)
}

pub(crate) const PROMISES: &[Promise<dyn Robot>] = &[
    ("robot/says-its-pose", poses),
    ("robot/moves-and-arrives", arrives),
    ("robot/refuses-targets-that-are-none", refuses_not_finite),
    ("robot/refuses-what-lies-outside", refuses_outside),
    ("robot/refuses-speeds-above-its-greatest", refuses_too_fast),
    ("robot/halts-twice-and-latches", latches_halt),
    ("robot/halt-within-50-ms", halts_from_another_thread),
    ("robot/timeout-stops-it", timeout_stops),
    ("robot/halt-from-all-sides", halts_from_all_sides),
    ("robot/guards-that-are-none", guards_as_declared),
    ("robot/dropped-in-any-state", dropped),
];

type Subject<'a> = Tried<'a, dyn Robot>;

/// Repeated poses of a resting robot agree and are in the workspace, and their stamps never decrease. A call whose deadline has passed returns at
/// once.
fn poses(tried: &Subject<'_>) -> Result<(), Unmet> {
    let mut robot = tried.open()?;
    let (first, mut last) = robot.pose(tried.trial.deadline)?;
    for _ in 0..20 {
        let (pose, stamp) = robot.pose(tried.trial.deadline)?;
        in_order(&[stamp])?;
        expect(last.valid_s <= stamp.valid_s, || {
            "a pose is older than the previous pose".to_owned()
        })?;
        near(tried, &pose, &first)?;
        last = stamp;
    }
    let _ = tried.at_once("a pose without time", || robot.pose(Deadline::PASSED))?;
    match facts(tried)?.workspace {
        Some(workspace) => expect(workspace.contains(&first.position), || {
            format!("its position {} is outside its workspace", first.position)
        }),
        None => Ok(()),
    }
}

fn arrives(tried: &Subject<'_>) -> Result<(), Unmet> {
    tried.may_move()?;
    let mut robot = tried.open()?;
    let course = Course::of(tried, &mut *robot)?;
    let there = robot.move_to(course.away, course.speed, tried.trial.deadline)?;
    let (pose, _) = robot.pose(tried.trial.deadline)?;
    near(tried, &pose, &course.away)?;
    let back = robot.move_to(course.home, course.speed, tried.trial.deadline)?;
    let (pose, _) = robot.pose(tried.trial.deadline)?;
    near(tried, &pose, &course.home)?;
    in_order(&[there, back])
}

fn refuses_not_finite(tried: &Subject<'_>) -> Result<(), Unmet> {
    let mut robot = tried.open()?;
    let course = Course::of(tried, &mut *robot)?;
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
            let moved = robot.move_to(target, course.speed, tried.trial.deadline);
            refused(
                &format!("moving to {target}"),
                moved,
                &[ErrorKind::InvalidArgument],
            )?;
        }
    }
    course.still_home(tried, &mut *robot)
}

fn refuses_outside(tried: &Subject<'_>) -> Result<(), Unmet> {
    let Some(workspace) = facts(tried)?.workspace else {
        return Err(skipped("it declares no workspace"));
    };
    let mut robot = tried.open()?;
    let course = Course::of(tried, &mut *robot)?;
    let mut beyond = course.home;
    beyond.position.x.0 = workspace.greatest.x.0 + 1.0;
    let mut below = course.home;
    below.position.y.0 = workspace.least.y.0 - 1.0;
    for target in [beyond, below] {
        let moved = robot.move_to(target, course.speed, tried.trial.deadline);
        refused(
            "moving out of the workspace",
            moved,
            &[ErrorKind::OutOfRange],
        )?;
    }
    course.still_home(tried, &mut *robot)
}

fn refuses_too_fast(tried: &Subject<'_>) -> Result<(), Unmet> {
    tried.may_move()?;
    let Some(greatest) = facts(tried)?.speed_max else {
        return Err(skipped("it declares no maximum speed"));
    };
    let mut robot = tried.open()?;
    let course = Course::of(tried, &mut *robot)?;
    let too_fast = speed(2.0 * greatest.mm_per_s())?;
    let moved = robot.move_to(course.away, too_fast, tried.trial.deadline);
    refused(
        "moving at twice its maximum speed",
        moved,
        &[ErrorKind::OutOfRange],
    )?;
    course.still_home(tried, &mut *robot)
}

/// A motion that exceeds its deadline is aborted. The robot stops and accepts the next motion.
fn timeout_stops(tried: &Subject<'_>) -> Result<(), Unmet> {
    tried.may_move()?;
    let deadline = tried.trial.deadline;
    let mut robot = tried.open()?;
    let course = Course::of(tried, &mut *robot)?;
    let moved = tried.at_once("moving without time", || {
        robot.move_to(course.away, course.speed, Deadline::PASSED)
    })?;
    refused("moving without time", moved, &[ErrorKind::Timeout])?;
    stands(tried, &mut *robot)?;
    // Long enough to begin the motion, and far too short to arrive.
    let slow = speed(tried.trial.travel.0)?;
    let moved = robot.move_to(
        course.away,
        slow,
        Deadline::after(Duration::from_millis(20)),
    );
    refused("a move of 1 s in 20 ms", moved, &[ErrorKind::Timeout])?;
    stands(tried, &mut *robot)?;
    robot.move_to(course.home, course.speed, deadline)?;
    course.still_home(tried, &mut *robot)
}

fn stands(tried: &Subject<'_>, robot: &mut dyn Robot) -> Result<(), Unmet> {
    let (first, _) = robot.pose(tried.trial.deadline)?;
    thread::sleep(Duration::from_millis(50));
    let (second, _) = robot.pose(tried.trial.deadline)?;
    near(tried, &second, &first)
}

fn latches_halt(tried: &Subject<'_>) -> Result<(), Unmet> {
    tried.may_move()?;
    let deadline = tried.trial.deadline;
    let mut robot = tried.open()?;
    let course = Course::of(tried, &mut *robot)?;
    robot.clear_halt(deadline)?;
    for _ in 0..2 {
        tried.at_once("halting", || robot.halt())??;
    }
    for _ in 0..2 {
        let moved = robot.move_to(course.away, course.speed, deadline);
        // A requested halt needs no acknowledgement, unlike a fault.
        let fault = moved.as_ref().err().and_then(DriverError::fault);
        expect(fault.is_none(), || {
            "moving after a requested halt names a fault, expected none".to_owned()
        })?;
        refused("moving after a halt", moved, &[ErrorKind::Interrupted])?;
    }
    course.still_home(tried, &mut *robot)?;
    robot.clear_halt(deadline)?;
    course.still_home(tried, &mut *robot)?;
    robot.move_to(course.away, course.speed, deadline)?;
    robot.move_to(course.home, course.speed, deadline)?;
    course.still_home(tried, &mut *robot)
}

fn halts_from_another_thread(tried: &Subject<'_>) -> Result<(), Unmet> {
    tried.may_move()?;
    let deadline = tried.trial.deadline;
    let mut robot = tried.open()?;
    let course = Course::of(tried, &mut *robot)?;
    let handle = robot.halt_handle();
    let moving = AtomicBool::new(false);
    // Set after the halt has returned: the time of its call, and its result.
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
        Ok(_) => return Err(broken("it accepted a motion after a halt")),
        Err((error, returned)) => {
            refused(
                "moving while it was halted",
                Err::<(), _>(error),
                &[ErrorKind::Interrupted],
            )?;
            let late = returned.saturating_duration_since(called);
            was_within("stopping", late, tried.trial.acts_within)?;
        }
    }
    let (first, _) = robot.pose(deadline)?;
    let (second, _) = robot.pose(deadline)?;
    near(tried, &second, &first)?;
    robot.clear_halt(deadline)?;
    robot.move_to(course.home, course.speed, deadline)?;
    course.still_home(tried, &mut *robot)
}

/// Calls of `halt` from four threads succeed. The halt handle of a dropped robot stops no other robot.
fn halts_from_all_sides(tried: &Subject<'_>) -> Result<(), Unmet> {
    let mut robot = tried.open()?;
    let handle = robot.halt_handle();
    let failed: usize = thread::scope(|scope| {
        let halters = [(); 4].map(|()| {
            let handle = &handle;
            scope.spawn(move || (0..500).filter(|_| handle.halt().is_err()).count())
        });
        halters
            .map(|halter| halter.join().unwrap_or(1))
            .iter()
            .sum()
    });
    expect(failed == 0, || format!("{failed} of 2000 halts failed"))?;
    robot.clear_halt(tried.trial.deadline)?;
    drop(robot);
    tried.at_once("halting a robot that is gone", || handle.halt())??;
    let mut next = tried.open()?;
    if tried.trial.moves {
        let course = Course::of(tried, &mut *next)?;
        next.move_to(course.home, course.speed, tried.trial.deadline)?;
    }
    Ok(())
}

fn dropped(tried: &Subject<'_>) -> Result<(), Unmet> {
    drop(tried.open()?);
    let mut robot = tried.open()?;
    robot.halt()?;
    drop(robot);
    drop(tried.open()?);
    Ok(())
}

fn guards_as_declared(tried: &Subject<'_>) -> Result<(), Unmet> {
    let declared = facts(tried)?.guarded_motion;
    let mut robot = tried.open()?;
    let course = Course::of(tried, &mut *robot)?;
    let Some(guarded) = robot.guarded_motion() else {
        return as_declared("stop itself at a force limit", declared, false);
    };
    as_declared("stop itself at a force limit", declared, true)?;
    for force in [f64::NAN, 0.0, -1.0] {
        let guard = Guard::at(Newton(force));
        let moved = guarded.move_guarded(course.home, course.speed, guard, tried.trial.deadline);
        let doing = format!("a guard of {force} N");
        refused(&doing, moved, &[ErrorKind::InvalidArgument])?;
    }
    course.still_home(tried, &mut *robot)
}

/// Short path from the first pose away from the gel, with the speed of the robot on this path.
struct Course {
    home: Pose,
    away: Pose,
    speed: Speed,
}

/// Speed of a robot in a trial, mm/s. A robot with a lower limit moves at this limit.
const UNHURRIED: f64 = 5.0;

impl Course {
    fn of(tried: &Subject<'_>, robot: &mut dyn Robot) -> Result<Course, Unmet> {
        let facts = facts(tried)?;
        let (home, _) = robot.pose(tried.trial.deadline)?;
        let mut away = home;
        away.position.z = Millimetre(home.position.z.0 - tried.trial.travel.0);
        if let Some(workspace) = facts
            .workspace
            .filter(|workspace| !workspace.contains(&away.position))
        {
            return Err(broken(format!(
                "{} of travel away from {} leaves the workspace {workspace}",
                tried.trial.travel, home.position
            )));
        }
        let greatest = facts.speed_max.map_or(UNHURRIED, Speed::mm_per_s);
        Ok(Course {
            home,
            away,
            speed: speed(greatest.min(UNHURRIED))?,
        })
    }

    /// Fails unless the robot is back at its first pose.
    fn still_home(&self, tried: &Subject<'_>, robot: &mut dyn Robot) -> Result<(), Unmet> {
        near(tried, &robot.pose(tried.trial.deadline)?.0, &self.home)
    }
}

fn speed(mm_per_s: f64) -> Result<Speed, Unmet> {
    Speed::try_new(mm_per_s).map_err(|error| broken(error.to_string()))
}

fn facts<'a>(tried: &'a Subject<'_>) -> Result<&'a RobotFacts, Unmet> {
    let facts = tried.descriptor.robot();
    facts.ok_or_else(|| broken("it does not declare itself a robot"))
}

/// Fails unless each coordinate of both positions differs by at most six standard deviations of a difference of two poses. Without a declared
/// repeatability, the limit is 0.1 mm.
fn near(tried: &Subject<'_>, found: &Pose, expected: &Pose) -> Result<(), Unmet> {
    const UNKNOWN_MM: f64 = 0.1;
    const ROUNDING_MM: f64 = 1e-6;
    let spread = facts(tried)?.repeatability;
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
        format!("its position is {found}, expected {expected} within {tolerance_mm} mm")
    })
}
