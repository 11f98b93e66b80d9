//! Tests of changers for specimens and units: they move only while the robot is halted, an operator can replace them, and they may fail.

use std::path::{Path, PathBuf};
use std::sync::{Arc, Condvar, Mutex};
use std::time::{Duration, Instant};

use taceva_acquire::{AcquireError, check_rig, read_rig};
use taceva_core::{Changer, Deadline, DriverError, ErrorKind, Interrupt, Progress, SilentProgress};
use taceva_dataset::Source;
use taceva_drivers::MonotonicClock;
use taceva_protocol::{Answer, Cancel, Left, Operator, Question, StopCause};
use taceva_study::StudyError;

use crate::waiting::devices::{CAROUSEL, drivers};
use crate::waiting::operator::LIGHTS;
use crate::waiting::record_on;
use crate::waiting::session::{self, UPRIGHT, rig_file, scene};
use crate::waiting::world::{Misfortune, World};

/// Scene of two units, each with its surface measured at two places. The tip is slow in contact, so that signals arrive in time on a busy machine.
const SCENE: &str = r#"
scene_version = 1
name = "wall"
robot = { driver = "wall/robot" }
force = { driver = "wall/force" }
[sensor]
driver = "wall/gel"
units = ["a", "b"]
[metrics]
want = ["inter_sensor"]
[protocol]
contact = { clearance_mm = 0.3, search_mm = 0.5, speed_mm_s = 1.5, travel_mm_s = 50.0, settle_s = 0.01 }
surface = { points = 2 }
"#;
/// Name of the specimen of the scene.
const BALL: &str = "sphere of radius 2 mm";
/// Duration of a change. The changer checks that the robot does not move meanwhile.
const CHANGE: Duration = Duration::from_millis(100);

/// Test changer that records before and after a change the height of the tip, and whether the robot is halted and moved.
pub(crate) struct Carousel {
    world: World,
    holds: Vec<String>,
    bell: Arc<Bell>,
}

#[derive(Default)]
struct Bell(Mutex<bool>, Condvar);

impl Interrupt for Bell {
    fn interrupt(&self) {
        *self.0.lock().expect("whole") = true;
        self.1.notify_all();
    }
}

impl Bell {
    /// True if the carousel was interrupted within `patience`. Resets the notification.
    fn rang_within(&self, patience: Duration) -> bool {
        let held = self.0.lock().expect("whole");
        let waited = self.1.wait_timeout_while(held, patience, |rang| !*rang);
        let (mut held, _) = waited.expect("whole");
        std::mem::take(&mut *held)
    }
}

impl Carousel {
    pub(crate) fn new(world: World, holds: Vec<String>) -> Carousel {
        let bell = Arc::default();
        Carousel { world, holds, bell }
    }

    fn look(&self) -> (f64, bool, u32) {
        let now_s = MonotonicClock.now_s();
        let state = self.world.state();
        (state.tip(now_s)[2], state.is_halted, state.motions)
    }
}

impl Changer for Carousel {
    fn holds(&self) -> &[String] {
        &self.holds
    }

    fn bring(&mut self, name: &str, deadline: Deadline) -> Result<String, DriverError> {
        let before = self.look();
        let misfortune = self.world.state().changer;
        let time = match misfortune {
            Misfortune::Hangs => deadline.remaining(),
            _ => CHANGE,
        };
        let was_interrupted = self.bell.rang_within(time);
        let after = self.look();
        let seen = (name.to_owned(), before.0, before.1, before == after);
        self.world.state().changes.push(seen);
        let failed = |kind| DriverError::new(kind, &CAROUSEL, "turn");
        match misfortune {
            _ if was_interrupted => Err(failed(ErrorKind::Interrupted)),
            Misfortune::None => Ok(name.to_owned()),
            Misfortune::Fails => Err(failed(ErrorKind::DeviceFault).because("it is stuck")),
            Misfortune::Hangs => Err(failed(ErrorKind::Timeout)),
            Misfortune::Vanishes => Err(failed(ErrorKind::Disconnected)),
            Misfortune::BringsAnother => Ok("sphere of radius 1 mm".to_owned()),
        }
    }

    fn interrupt_handle(&self) -> Option<Arc<dyn Interrupt>> {
        Some(Arc::clone(&self.bell) as Arc<dyn Interrupt>)
    }
}

/// Path of a new rig file with the changers in `changers`. It states that the rig is emulated, so that no operator has to enable the robot.
fn rig(folder: &Path, changers: &str) -> PathBuf {
    let path = rig_file(folder, UPRIGHT);
    let text = std::fs::read_to_string(&path).expect("written");
    let text = text.replacen("rig_version = 1", "rig_version = 1\nsimulated = true", 1);
    std::fs::write(&path, format!("{text}[changers]\n{changers}\n")).expect("written");
    path
}

/// Lines of a rig file for two changers, which hold the specimen and both units of the scene.
fn both() -> String {
    format!(
        "specimen = \"wall/carousel:holds={BALL}\"\nunit = \"wall/revolver:holds=a+b\"\npatience_s = 0.5"
    )
}

#[test]
fn changers_bring_units_and_specimens_while_the_robot_stands_halted_and_nobody_is_needed() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let rig = rig(folder.path(), &both());
    let run = folder.path().join("run");
    // An earlier run left the tip in the gel.
    assert!(world.travel([0.0, 0.0, 0.2], 50.0));
    let whole = record_on(&world, &run, &SilentProgress, (SCENE, Some(&rig), None));
    assert_eq!(whole.expect("two units").table().samples().len(), 4);
    let changes = world.state().changes.clone();
    let names: Vec<&str> = changes.iter().map(|change| change.0.as_str()).collect();
    assert_eq!(names, ["a", BALL, "b", BALL]);
    for (_, height_mm, was_halted, stood) in &changes {
        // The clearance of the scene is 0.3 mm.
        assert!(
            *height_mm <= -0.3 + 1e-9 && *was_halted && *stood,
            "{changes:?}"
        );
    }
}

#[test]
fn a_check_of_a_rig_opens_its_changers_and_its_light_and_moves_none_of_them() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let changers = format!("{}\nlight = \"wall/lamp\"", both());
    let file = read_rig(&rig(folder.path(), &changers)).expect("a rig");
    let check = check_rig(&file, &drivers(&world), None).expect("a right file");
    let found = check.changers.iter();
    let found: Vec<String> = found
        .map(|changer| format!("{}: {}", changer.key, changer.holds.join(", ")))
        .collect();
    let ball = format!("specimen: {BALL}");
    assert_eq!(found, [ball.as_str(), "unit: a, b", "light: dark, lamp"]);
    assert!(world.state().changes.is_empty() && world.state().lights.is_empty());
}

#[test]
fn one_simulated_changer_makes_the_recording_of_a_real_rig_a_simulated_one() {
    for (changer, source) in [
        ("carousel", Source::Recorded),
        ("revolver", Source::Simulated),
    ] {
        let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
        let rig = rig_file(folder.path(), UPRIGHT);
        let text = std::fs::read_to_string(&rig).expect("written");
        let changers = format!("[changers]\nspecimen = \"wall/{changer}:holds={BALL}\"\n");
        std::fs::write(&rig, text + &changers).expect("written");
        let person = Mutex::new(session::Person::default());
        let whole = record_on(
            &world,
            &folder.path().join("run"),
            &SilentProgress,
            (&scene(), Some(&rig), Some(&person)),
        );
        let whole = whole.expect("somebody lets it move");
        assert_eq!(whole.header().source, source, "{changer}");
    }
}

#[test]
fn a_light_of_the_rig_file_stands_in_the_place_of_hands_and_is_set_above_the_gel() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let rig = rig(folder.path(), "light = \"wall/lamp\"");
    let run = folder.path().join("run");
    let whole = record_on(&world, &run, &SilentProgress, (LIGHTS, Some(&rig), None));
    let whole = whole.expect("nobody is needed");
    let lights = world.state().lights.clone();
    let mut names: Vec<&str> = lights.iter().map(|(name, _)| name.as_str()).collect();
    names.dedup();
    assert_eq!(names, ["dark", "lamp"]);
    assert!(
        lights.iter().all(|(_, height_mm)| *height_mm <= 0.0),
        "{lights:?}"
    );
    let scenes = whole.table().as_text("scene").expect("kept");
    let under = |name: &str| scenes.iter().any(|scene| scene.as_deref() == Some(name));
    assert!(under("dark") && under("lamp"), "{scenes:?}");
}

#[test]
fn a_changer_that_fails_ends_an_unattended_run_with_everything_recorded_and_the_next_call_goes_on()
{
    for (misfortune, said) in [
        (Misfortune::Fails, "it is stuck"),
        (Misfortune::Hangs, "turn"),
        (Misfortune::Vanishes, "turn"),
        (
            Misfortune::BringsAnother,
            "`sphere of radius 1 mm` in place, expected `sphere of radius 2 mm`",
        ),
    ] {
        let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
        let rig = rig(
            folder.path(),
            &format!("specimen = \"wall/carousel:holds={BALL}\"\npatience_s = 0.5"),
        );
        let run = folder.path().join("run");
        let scene = scene();
        world.state().changer = misfortune;
        let begun = Instant::now();
        let stopped = record_on(&world, &run, &SilentProgress, (&scene, Some(&rig), None));
        let Err(StudyError::Acquire(AcquireError::Acquisition { source, .. })) = stopped else {
            panic!("{misfortune:?}: {stopped:?}");
        };
        assert!(matches!(source.cause, StopCause::Device(_)), "{source}");
        assert!(
            source.to_string().contains(said),
            "{misfortune:?}: {source}"
        );
        assert_eq!(source.left, Left::Clear);
        assert!(begun.elapsed() < Duration::from_secs(20));
        let now_s = MonotonicClock.now_s();
        let mut state = world.state();
        assert!(state.is_halted && state.tip(now_s)[2] <= -0.3 + 1e-9);
        assert_eq!(state.motions, 0, "{misfortune:?}");
        state.changer = Misfortune::None;
        drop(state);
        let whole = record_on(&world, &run, &SilentProgress, (&scene, Some(&rig), None));
        assert_eq!(whole.expect("it goes on").table().samples().len(), 6);
    }
}

/// Test operator who records the questions, repairs the changer, and answers that the step is done.
struct Person(World, Vec<Question>);

impl Operator for Person {
    fn ask(&mut self, question: &Question, _: &Cancel) -> Answer {
        self.1.push(question.clone());
        self.0.state().changer = Misfortune::None;
        Answer::Done
    }
}

#[test]
fn where_somebody_is_there_the_change_is_asked_for_instead_with_what_the_changer_said() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let rig = rig(folder.path(), &both());
    let run = folder.path().join("run");
    world.state().changer = Misfortune::Fails;
    let person = Mutex::new(Person(world.clone(), Vec::new()));
    let whole = record_on(
        &world,
        &run,
        &SilentProgress,
        (SCENE, Some(&rig), Some(&person)),
    );
    assert_eq!(whole.expect("by hand").table().samples().len(), 4);
    let asked = &person.lock().expect("whole").1;
    let [Question::Instead { of_changer, why }] = &asked[..] else {
        panic!("{asked:?}");
    };
    assert_eq!(**of_changer, Question::Unit("a".to_owned()));
    assert!(why.contains("it is stuck"), "{why}");
}

#[test]
fn what_a_changer_does_not_hold_needs_somebody_and_is_named_before_anything_is_opened() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let rig = rig(
        folder.path(),
        "specimen = \"wall/carousel:holds=sphere of radius 1 mm\"\nunit = \"wall/revolver:holds=a\"",
    );
    let run = folder.path().join("run");
    let refused = record_on(&world, &run, &SilentProgress, (SCENE, Some(&rig), None));
    let text = refused.expect_err("nobody is there").to_string();
    let needed =
        "2 specimens are changed by hand, which the changer does not hold: sphere of radius 2 mm";
    assert!(text.contains(needed), "{text}");
    let needed = "1 unit of the sensor is changed by hand, which the changer does not hold: b";
    assert!(text.contains(needed), "{text}");
    assert_eq!(world.state().readings, 0);
}

#[test]
fn a_changer_that_is_none_or_holds_nothing_is_refused_with_its_line() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let run = folder.path().join("run");
    for (changers, said) in [
        (
            "specimen = \"wall/carousl:holds=a\"",
            "line 14: `wall/carousl`",
        ),
        ("unit = \"wall/revolver:holds=\"", "line 14:"),
        ("units = \"wall/revolver:holds=a\"", "line 14:"),
        ("patience_s = 0.0", "line 14: `patience_s`"),
    ] {
        let rig = rig(folder.path(), changers);
        let refused = record_on(&world, &run, &SilentProgress, (SCENE, Some(&rig), None));
        let text = refused.expect_err(changers).to_string();
        assert!(text.contains(said), "{changers}: {text}");
        assert!(world.state().changes.is_empty());
    }
}

/// Progress receiver that requests a stop 300 ms after the given time, while the changer moves.
struct StopsMeanwhile(Instant);

impl Progress for StopsMeanwhile {
    fn is_cancelled(&self) -> bool {
        self.0.elapsed() > Duration::from_millis(300)
    }
}

#[test]
fn a_wish_to_stop_reaches_a_changer_that_moves() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let changers = format!(
        "specimen = \"wall/carousel:holds={BALL}\"\nunit = \"wall/revolver:holds=a+b\"\npatience_s = 600.0"
    );
    let rig = rig(folder.path(), &changers);
    let run = folder.path().join("run");
    world.state().changer = Misfortune::Hangs;
    let begun = Instant::now();
    let stopped = record_on(
        &world,
        &run,
        &StopsMeanwhile(begun),
        (SCENE, Some(&rig), None),
    );
    let Err(StudyError::Acquire(AcquireError::Acquisition { source, .. })) = stopped else {
        panic!("{stopped:?}");
    };
    assert!(matches!(source.cause, StopCause::Cancelled), "{source}");
    assert!(
        begun.elapsed() < Duration::from_secs(5),
        "{:?}",
        begun.elapsed()
    );
    assert_eq!(world.state().changes.len(), 1);
}
