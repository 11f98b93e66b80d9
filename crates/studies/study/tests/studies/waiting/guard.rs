//! Tests of the guard threads while the robot moves, and of their reactions.

use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

use taceva_acquire::AcquireError;
use taceva_core::{Fault, Progress};
use taceva_dataset::Dataset;
use taceva_protocol::{Left, RunError, StopCause, Trip};
use taceva_study::StudyError;

use crate::waiting::record;
use crate::waiting::world::World;

/// Progress receiver that calls its function with the emulated rig whenever a run checks for cancellation, a hundred times a second.
struct Looking<'a, F>(&'a World, F);

#[derive(Clone, Copy, Default)]
struct Wishes {
    is_cancelled: bool,
    is_insisted: bool,
}

impl<F: Fn(&World) -> Wishes + Send + Sync> Progress for Looking<'_, F> {
    fn is_cancelled(&self) -> bool {
        (self.1)(self.0).is_cancelled
    }
    fn is_insisted(&self) -> bool {
        (self.1)(self.0).is_insisted
    }
}

/// Records the scene. `look` observes the emulated rig meanwhile and may request a stop.
fn looked_on(
    world: &World,
    folder: &Path,
    look: impl Fn(&World) -> Wishes + Send + Sync,
) -> Result<Dataset, StudyError> {
    record(world, folder, &Looking(world, look))
}

pub(crate) fn stopped(done: Result<Dataset, StudyError>) -> RunError {
    match done {
        Err(StudyError::Acquire(AcquireError::Acquisition { source, .. })) => *source,
        Err(other) => panic!("{other}"),
        Ok(_) => panic!("it went on to its end"),
    }
}

pub(crate) fn depth_mm(world: &World) -> f64 {
    let state = world.state();
    state.tip(taceva_drivers::MonotonicClock.now_s())[2]
}

/// Asserts that every sample of the scene was recorded once: three presses with two samples each.
fn assert_whole(dataset: &Dataset) {
    let mut names: Vec<&String> = dataset.table().samples().iter().collect();
    assert_eq!(names.len(), 6);
    names.sort();
    names.dedup();
    assert_eq!(names.len(), 6);
}

#[test]
fn a_collision_on_the_way_through_the_air_is_seen_before_its_end() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    // Presses lie on both sides; the first one to the right is not reached.
    world.state().obstacle_x_mm = 0.05;
    let error = stopped(looked_on(&world, &folder.path().join("run"), |_| {
        Wishes::default()
    }));
    assert!(
        matches!(
            error.cause,
            StopCause::Tripped(Trip::UnexpectedContact { .. })
        ),
        "{error}"
    );
    let state = world.state();
    let struck_s = state.struck_s.expect("it came there");
    let late_s = state.first_halt_after(struck_s) - struck_s;
    // The next reading comes after 5 ms; the rest is the time to wake a thread on a busy machine.
    assert!((0.0..0.2).contains(&late_s), "{late_s} s");
}

#[test]
fn a_press_is_made_again_after_a_gap_in_the_stream_of_forces() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let was_silent = AtomicBool::new(false);
    let dataset = looked_on(&world, &folder.path().join("run"), |world| {
        if depth_mm(world) > 0.1 && !was_silent.swap(true, Ordering::SeqCst) {
            // Six calls of 20 ms each.
            world.state().withheld = 6;
        }
        Wishes::default()
    });
    assert_whole(&dataset.expect("it spoke again"));
    assert!(was_silent.load(Ordering::SeqCst));
    assert!(world.state().halts > 0, "it was halted for silence");
}

#[test]
fn a_wish_to_stop_ends_a_motion_and_the_tip_leaves_the_gel_and_what_was_recorded_goes_on() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let folder = folder.path().join("run");
    let was_deep = AtomicBool::new(false);
    let error = stopped(looked_on(&world, &folder, |world| {
        was_deep.fetch_or(depth_mm(world) > 0.1, Ordering::SeqCst);
        Wishes {
            is_cancelled: was_deep.load(Ordering::SeqCst),
            ..Wishes::default()
        }
    }));
    assert!(matches!(error.cause, StopCause::Cancelled), "{error}");
    assert_eq!(error.left, Left::Clear);
    assert!(depth_mm(&world) < -0.29);
    let dataset = looked_on(&world, &folder, |_| Wishes::default());
    assert_whole(&dataset.expect("it goes on"));
}

/// Progress receiver that cancels the run during a motion, and records the remarks. The halt of this motion is answered late.
struct Cancelling<'a> {
    world: &'a World,
    is_cancelled: AtomicBool,
    remarks: Mutex<Vec<String>>,
}

/// Delay of the answer to a halt.
const ANSWER_DELAY: Duration = Duration::from_millis(300);
/// Least time from the start of the motion to the cancellation, in s: two turns of the guard.
const BEGUN_S: f64 = 0.012;

impl Progress for Cancelling<'_> {
    fn is_cancelled(&self) -> bool {
        let mut state = self.world.state();
        let now_s = taceva_drivers::MonotonicClock.now_s();
        if !self.is_cancelled.load(Ordering::SeqCst) && state.is_amid_motion(now_s, BEGUN_S) {
            state.answer_delay = ANSWER_DELAY;
            self.is_cancelled.store(true, Ordering::SeqCst);
        }
        self.is_cancelled.load(Ordering::SeqCst)
    }

    fn remark(&self, words: &str) {
        self.remarks.lock().expect("whole").push(words.to_owned());
    }
}

#[test]
fn a_halt_that_the_robot_answers_late_is_printed_and_counted_as_late_by_the_robot_or_its_link() {
    let (world, temporary) = (World::new(), tempfile::tempdir().expect("a folder"));
    let folder = temporary.path().join("run");
    let cancelling = Cancelling {
        world: &world,
        is_cancelled: AtomicBool::new(false),
        remarks: Mutex::default(),
    };
    stopped(record(&world, &folder, &cancelling));
    let remarks = cancelling.remarks.into_inner().expect("whole");
    let begins = |begin: &'static str| remarks.iter().filter(move |line| line.starts_with(begin));
    // A kernel without these statistics leaves the cause unknown.
    let (words, count) = match Path::new("/proc/thread-self/schedstat").exists() {
        true => ("which waited for its answer: the robot", "1 by a device"),
        false => ("this kernel does not state", "1 of unknown cause"),
    };
    let late = begins("late: the stop of the robot took ").filter(|line| line.contains(words));
    assert_eq!(late.count(), 1, "{remarks:?}");
    let counts: Vec<&String> = begins("halts in this session: ").collect();
    assert_eq!(counts.len(), 1, "{remarks:?}");
    assert!(counts[0].contains(count), "{remarks:?}");
    // The recording that goes on keeps it as a warning, which the report shows.
    let dataset = looked_on(&world, &folder, |_| Wishes::default()).expect("it goes on");
    let warnings = &dataset.header().warnings;
    let expected = format!("the robot was halted late: {}", counts[0]);
    assert!(warnings.contains(&expected), "{warnings:?}");
}

#[test]
fn who_wishes_twice_leaves_the_tip_where_it_is() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let was_deep = AtomicBool::new(false);
    let error = stopped(looked_on(&world, &folder.path().join("run"), |world| {
        let is_deep = was_deep.fetch_or(depth_mm(world) > 0.1, Ordering::SeqCst);
        Wishes {
            is_cancelled: is_deep,
            is_insisted: is_deep,
        }
    }));
    assert!(matches!(error.cause, StopCause::Cancelled), "{error}");
    assert_eq!(error.left, Left::InPlace);
    assert!(world.state().is_halted);
}

#[test]
fn after_an_emergency_stop_nothing_moves_and_nothing_is_cleared() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let error = stopped(looked_on(&world, &folder.path().join("run"), |world| {
        if depth_mm(world) > 0.1 {
            world.stop();
        }
        Wishes::default()
    }));
    assert_eq!(error.cause.fault(), Some(Fault::EmergencyStop), "{error}");
    assert_eq!(error.left, Left::InPlace);
    assert_eq!(world.state().defied, 0);
    let place = depth_mm(&world);
    assert!(place > 0.1, "{place} mm");
}
