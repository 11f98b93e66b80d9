//! Tests of sessions on the rig of a rig file: permission to move, checks before presses, and the table of sessions.

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};

use taceva_acquire::AcquireError;
use taceva_core::{Progress, SilentProgress};
use taceva_dataset::Source;
use taceva_protocol::{Answer, Cancel, Operator, Question, StopCause};
use taceva_study::{Existing, RunFolder, StudyError};

use crate::waiting::world::World;
use crate::waiting::{SCENE, record_on, with_workshop};

/// Path of a new rig file for the emulated rig, whose transducer has the axes `force_axes`.
pub(crate) fn rig_file(folder: &Path, force_axes: &str) -> PathBuf {
    let path = folder.join("lab.toml");
    let text = format!(
        "rig_version = 1\n[robot]\ndriver = \"wall/robot\"\ncarries = \"indenter\"\norigin_mm = [0.0, 0.0, 0.0]\naxes = [\"x\", \"y\", \"z\"]\n[force]\ndriver = \"wall/force\"\naxes = {force_axes}\n[sensor]\ndriver = \"wall/gel\"\n"
    );
    std::fs::write(&path, text).expect("written");
    path
}

/// Text of a scene whose tip is slow in contact, so that signals arrive in time on a busy machine.
pub(crate) fn scene() -> String {
    SCENE.replacen("speed_mm_s = 5.0", "speed_mm_s = 1.5", 1)
}

pub(crate) const UPRIGHT: &str = "[\"x\", \"y\", \"z\"]";

/// Test operator who answers that every step is done, and records the questions.
#[derive(Default)]
pub(crate) struct Person(Vec<Question>);

impl Operator for Person {
    fn ask(&mut self, question: &Question, _: &Cancel) -> Answer {
        self.0.push(question.clone());
        Answer::Done
    }
}

fn rows(folder: &Path) -> Vec<String> {
    let table = folder.join("recordings/1-wall.sessions.csv");
    let text = std::fs::read_to_string(table).expect("a table of sessions");
    text.lines().skip(1).map(str::to_owned).collect()
}

/// Progress receiver that requests a stop when the tip is in the gel, once the session table exists.
struct StopsInPress<'a>(&'a World, PathBuf, AtomicBool);

impl Progress for StopsInPress<'_> {
    fn is_cancelled(&self) -> bool {
        let now_s = taceva_drivers::MonotonicClock.now_s();
        let is_deep = self.0.state().tip(now_s)[2] > 0.3;
        self.2
            .fetch_or(is_deep && self.1.exists(), Ordering::SeqCst)
            || is_deep && self.1.exists()
    }
}

#[test]
fn a_session_is_enabled_tried_and_written_down_and_the_next_one_goes_on_where_the_gel_is_the_same()
{
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let rig = rig_file(folder.path(), UPRIGHT);
    let run = folder.path().join("run");
    let person = Mutex::new(Person::default());
    let table = run.join("recordings/1-wall.sessions.csv");
    let stops = StopsInPress(&world, table, AtomicBool::new(false));
    let stopped = record_on(&world, &run, &stops, (&scene(), Some(&rig), Some(&person)));
    let Err(StudyError::Acquire(AcquireError::Acquisition { source, .. })) = stopped else {
        panic!("it was stopped in a press");
    };
    assert!(matches!(source.cause, StopCause::Cancelled), "{source}");
    let asked = person.lock().expect("whole").0.clone();
    let enable = asked[0].to_string();
    assert!(
        enable.starts_with("`wall/robot` is about to move: up to ")
            && enable.contains("a gentle touch, then 3 presses;"),
        "{enable}"
    );
    assert!(matches!(asked[1..], [Question::Mount(_)]), "{asked:?}");
    assert_eq!(rows(&run).len(), 1);

    let dataset = record_on(
        &world,
        &run,
        &SilentProgress,
        (&scene(), Some(&rig), Some(&person)),
    );
    assert_eq!(dataset.expect("it goes on").table().samples().len(), 6);
    let rows = rows(&run);
    assert_eq!(rows.len(), 2);
    let asked = person.lock().expect("whole").0.clone();
    let resumed = asked
        .iter()
        .any(|asked| matches!(asked, Question::Resume(_)));
    assert!(!resumed && asked.len() == 4, "{asked:?}");
    // The same boot id, and consistent columns of lengths and forces.
    let fields: Vec<Vec<&str>> = rows.iter().map(|row| row.split(',').collect()).collect();
    assert_eq!(fields[0][0], fields[1][0]);
    let number =
        |row: usize, column: usize| -> f64 { fields[row][column].parse().expect("a number") };
    assert!((number(0, 4) - number(1, 4)).abs() <= 0.1, "{rows:?}");
    assert!((number(0, 6) / number(1, 6) - 1.0).abs() <= 0.1, "{rows:?}");
    // A load of 0.3 N rests on the transducer.
    assert!((number(0, 9) - 0.3).abs() < 0.01, "{rows:?}");
}

#[test]
fn a_robot_that_reports_an_emulation_makes_the_recording_simulated_whatever_the_rig_file_says() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let rig = rig_file(folder.path(), UPRIGHT);
    let person = Mutex::new(Person::default());
    for (is_emulated, source) in [(false, Source::Recorded), (true, Source::Simulated)] {
        world.state().is_emulated = is_emulated;
        let dataset = record_on(
            &world,
            &folder.path().join(format!("run-{is_emulated}")),
            &SilentProgress,
            (&scene(), Some(&rig), Some(&person)),
        );
        assert_eq!(dataset.expect("a recording").header().source, source);
    }
}

#[test]
fn a_transducer_that_is_upside_down_in_the_rig_file_stops_the_session_before_its_first_press() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let rig = rig_file(folder.path(), "[\"x\", \"-y\", \"-z\"]");
    let run = folder.path().join("run");
    let person = Mutex::new(Person::default());
    let refused = record_on(
        &world,
        &run,
        &SilentProgress,
        (&scene(), Some(&rig), Some(&person)),
    );
    let said = refused.expect_err("pressed, it pulls").to_string();
    let line =
        "lab.toml, line 9: `axes` of [force]: pressed along +z, the force was measured along -z";
    assert!(said.contains(line), "{said}");
    let state = world.state();
    // At most half of the allowed depth, and out again.
    assert!(state.deepest_mm < 0.5, "{} mm", state.deepest_mm);
    assert!(state.tip(taceva_drivers::MonotonicClock.now_s())[2] < -0.29);
    assert!(!run.join("recordings/1-wall.sessions.csv").exists());
}

#[test]
fn a_robot_that_nobody_is_there_to_let_move_is_refused_before_anything_is_opened() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let rig = rig_file(folder.path(), UPRIGHT);
    let run = folder.path().join("run");
    let refused = record_on(&world, &run, &SilentProgress, (&scene(), Some(&rig), None));
    let refused = refused.expect_err("nobody is there");
    assert!(refused.is_usage());
    let said = refused.to_string();
    assert!(
        said.contains("this rig needs an operator: `wall/robot` is enabled by hand"),
        "{said}"
    );
    assert_eq!(world.state().readings, 0);
}

/// Progress receiver that requests a stop from the given time of the clock on, in s.
struct StopsAfter(f64);

impl StopsAfter {
    fn seconds(seconds: f64) -> StopsAfter {
        StopsAfter(taceva_drivers::MonotonicClock.now_s() + seconds)
    }
}

impl Progress for StopsAfter {
    fn is_cancelled(&self) -> bool {
        taceva_drivers::MonotonicClock.now_s() >= self.0
    }
}

#[test]
fn ctrl_c_at_any_moment_leaves_the_tip_above_the_gel_and_no_press_is_lost_or_doubled() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let rig = rig_file(folder.path(), UPRIGHT);
    let run = folder.path().join("run");
    let person = Mutex::new(Person::default());
    // Stops while readings are timed, in the air, in the gentle touch, and in presses.
    for seconds in [0.3, 2.2, 2.9, 3.6, 4.4, 5.3] {
        let stops = StopsAfter::seconds(seconds);
        let stopped = record_on(&world, &run, &stops, (&scene(), Some(&rig), Some(&person)));
        match stopped {
            Err(StudyError::Acquire(AcquireError::Acquisition { source, .. })) => {
                assert!(
                    matches!(source.cause, StopCause::Cancelled),
                    "{seconds}: {source}"
                );
            }
            Err(other) => panic!("{seconds}: {other}"),
            // A fast machine has finished already.
            Ok(_) => {}
        }
        let tip = world.state().tip(taceva_drivers::MonotonicClock.now_s());
        assert!(tip[2] < -0.29, "{seconds}: {tip:?}");
    }
    let dataset = record_on(
        &world,
        &run,
        &SilentProgress,
        (&scene(), Some(&rig), Some(&person)),
    );
    let dataset = dataset.expect("it goes on");
    let mut names: Vec<String> = dataset.table().samples().to_vec();
    names.sort();
    names.dedup();
    assert_eq!(names.len(), 6);
}

#[test]
fn a_run_that_another_operator_resumes_is_refused_with_both_names_and_the_remedy() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let rig = rig_file(folder.path(), UPRIGHT);
    let devices = std::fs::read_to_string(&rig).expect("written");
    let (run, pressed) = (folder.path().join("run"), scene());
    let opened = |name: &str, existing: Existing| {
        let text = format!("{devices}[operator]\nname = \"{name}\"\n");
        std::fs::write(&rig, text).expect("written");
        let on = (pressed.as_str(), Some(rig.as_path()), None);
        with_workshop(&world, &SilentProgress, on, |planned, _| {
            RunFolder::open(&run, planned, existing)
        })
    };
    opened("Ada", Existing::Refuse).expect("a new run");
    opened("Ada", Existing::Resume).expect("the same person");
    let refused = opened("Grace", Existing::Resume).expect_err("another person");
    let said = refused.to_string();
    for words in [
        "the operator was `Ada` and is now `Grace` (`name` under [operator] of the rig file)",
        "undo this change and use --resume, or choose another folder",
    ] {
        assert!(said.contains(words), "{said}");
    }
}

/// Test operator who answers no question, and waits until the run is cancelled. Records the number of motions before the question.
struct WalkedAway(World, u32);

impl Operator for WalkedAway {
    fn ask(&mut self, _: &Question, cancel: &Cancel) -> Answer {
        self.1 = self.0.state().motions;
        while !cancel.is_cancelled() {
            std::thread::sleep(std::time::Duration::from_millis(10));
        }
        Answer::Stop
    }
}

#[test]
fn an_operator_who_walks_away_is_waited_for_while_nothing_moves_until_somebody_stops_the_run() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let rig = rig_file(folder.path(), UPRIGHT);
    let run = folder.path().join("run");
    let nobody = Mutex::new(WalkedAway(world.clone(), u32::MAX));
    let stops = StopsAfter::seconds(1.0);
    let stopped = record_on(&world, &run, &stops, (&scene(), Some(&rig), Some(&nobody)));
    let said = stopped.expect_err("nobody let it move").to_string();
    assert!(said.contains("stopped on request"), "{said}");
    assert_eq!(
        (nobody.lock().expect("whole").1, world.state().motions),
        (0, 0)
    );
}

#[test]
fn a_disk_that_takes_no_session_stops_it_before_its_first_press() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let rig = rig_file(folder.path(), UPRIGHT);
    let run = folder.path().join("run");
    let person = Mutex::new(Person::default());
    // A folder blocks the path of the session table.
    let in_the_way = run.join("recordings/1-wall.sessions.csv");
    let blocks = Blocks(in_the_way.clone());
    let stopped = record_on(&world, &run, &blocks, (&scene(), Some(&rig), Some(&person)));
    let Err(StudyError::Acquire(AcquireError::Acquisition { source, .. })) = stopped else {
        panic!("it could not be written");
    };
    assert!(matches!(source.cause, StopCause::Log(_)), "{source}");
    assert!(world.state().deepest_mm < 0.5);
    std::fs::remove_dir(&in_the_way).expect("it is there");
    let dataset = record_on(
        &world,
        &run,
        &SilentProgress,
        (&scene(), Some(&rig), Some(&person)),
    );
    assert_eq!(dataset.expect("it goes on").table().samples().len(), 6);
}

/// Progress receiver that creates a folder at the path of the session table, so that the table cannot be written.
struct Blocks(PathBuf);

impl Progress for Blocks {
    fn begin(&self, _: &str, _: Option<u64>) {
        std::fs::create_dir_all(&self.0).expect("made");
    }
    fn is_cancelled(&self) -> bool {
        false
    }
}
