//! Tests of a study that needs an operator: without an operator the study is rejected, and with an operator the steps are requested.

use std::sync::Mutex;

use taceva_acquire::AcquireError;
use taceva_core::SilentProgress;
use taceva_protocol::{Answer, Cancel, Operator, Question, StopCause};
use taceva_study::StudyError;

use crate::waiting::record_by_hand;
use crate::waiting::world::World;

/// Scene of two units, each with its surface measured at two places.
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
contact = { clearance_mm = 0.3, search_mm = 0.5, speed_mm_s = 5.0, travel_mm_s = 50.0, settle_s = 0.01 }
surface = { points = 2 }
"#;

struct ScriptedOperator {
    asked: Vec<Question>,
    answer: fn(&Question) -> Answer,
}

impl Operator for ScriptedOperator {
    fn ask(&mut self, question: &Question, _: &Cancel) -> Answer {
        self.asked.push(question.clone());
        (self.answer)(question)
    }
}

fn unit(name: &str) -> Question {
    Question::Unit(name.to_owned())
}

#[test]
fn a_scene_that_needs_hands_is_refused_where_nobody_can_be_asked_before_anything_is_opened() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let path = folder.path().join("run");
    let refused = record_by_hand(&world, &path, &SilentProgress, (SCENE, None));
    let refused = refused.expect_err("nobody is there");
    assert!(refused.is_usage());
    let text = refused.to_string();
    let needed = "this rig needs an operator: 2 units of the sensor are changed by hand";
    assert!(text.contains(needed), "{text}");
    assert_eq!(world.state().readings, 0);
}

#[test]
fn each_unit_is_asked_for_and_one_that_is_skipped_is_left_for_the_next_call() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let path = folder.path().join("run");
    let hands = Mutex::new(ScriptedOperator {
        asked: Vec::new(),
        answer: |question| match *question == unit("b") {
            true => Answer::Skip,
            false => Answer::Done,
        },
    });
    let left = record_by_hand(&world, &path, &SilentProgress, (SCENE, Some(&hands)));
    let Err(StudyError::Acquire(AcquireError::Acquisition { source, .. })) = left else {
        panic!("unit b was skipped");
    };
    assert!(
        matches!(source.cause, StopCause::Skipped { presses: 2 }),
        "{source}"
    );
    let mut held = hands.lock().expect("whole");
    let [first, mount, last] = &held.asked[..] else {
        panic!("{:?}", held.asked);
    };
    assert_eq!([first, last], [&unit("a"), &unit("b")]);
    assert!(matches!(mount, Question::Mount(_)));
    held.answer = |_| Answer::Done;
    drop(held);
    let whole = record_by_hand(&world, &path, &SilentProgress, (SCENE, Some(&hands)));
    let whole = whole.expect("unit b too");
    assert_eq!(whole.table().samples().len(), 4);
}

/// Test operator who answers that every step is done, and records the warnings.
struct Warned(Vec<String>);

impl Operator for Warned {
    fn ask(&mut self, _: &Question, _: &Cancel) -> Answer {
        Answer::Done
    }

    fn warn(&mut self, warning: &str) {
        self.0.push(warning.to_owned());
    }
}

#[test]
fn a_remark_of_the_transducer_is_shown_once_for_all_units() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let path = folder.path().join("run");
    let hands = Mutex::new(Warned(Vec::new()));
    let whole = record_by_hand(&world, &path, &SilentProgress, (SCENE, Some(&hands)));
    assert_eq!(whole.expect("two units").table().samples().len(), 4);
    let warned = &hands.lock().expect("whole").0;
    assert_eq!(warned[..], ["a low pass delays forces: switch it off"]);
}

/// Test operator who records three facts when a unit is requested: the height of the tip, if it is halted, and if it stays still until the answer.
struct Hands {
    world: World,
    seen: Vec<(f64, bool, bool)>,
}

impl Operator for Hands {
    fn ask(&mut self, question: &Question, _: &Cancel) -> Answer {
        if let Question::Unit(_) = question {
            let (height_mm, is_halted, motions) = self.look();
            std::thread::sleep(std::time::Duration::from_millis(100));
            let is_still = (height_mm, is_halted, motions) == self.look();
            self.seen.push((height_mm, is_halted, is_still));
        }
        Answer::Done
    }
}

impl Hands {
    fn look(&self) -> (f64, bool, u32) {
        let state = self.world.state();
        let now_s = taceva_drivers::MonotonicClock.now_s();
        (state.tip(now_s)[2], state.is_halted, state.motions)
    }
}

#[test]
fn a_tip_that_stands_in_the_gel_is_raised_and_halted_before_a_unit_is_asked_for() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let path = folder.path().join("run");
    // An earlier run left the tip 0.2 mm deep.
    assert!(world.travel([0.0, 0.0, 0.2], 50.0));
    let hands = Mutex::new(Hands {
        world: world.clone(),
        seen: Vec::new(),
    });
    let whole = record_by_hand(&world, &path, &SilentProgress, (SCENE, Some(&hands)));
    assert_eq!(whole.expect("two units").table().samples().len(), 4);
    let seen = &hands.lock().expect("whole").seen;
    assert_eq!(seen.len(), 2);
    for (height_mm, is_halted, is_still) in seen {
        // The clearance of the scene is 0.3 mm.
        assert!(
            *height_mm <= -0.3 + 1e-9 && *is_halted && *is_still,
            "{seen:?}"
        );
    }
}

/// Scene of one unit under two lights that no device sets.
pub(crate) const LIGHTS: &str = r#"
scene_version = 1
name = "wall"
robot = { driver = "wall/robot" }
force = { driver = "wall/force" }
sensor = { driver = "wall/gel", opaque = false }
lighting = { scenes = ["dark", "lamp"] }
model = { name = "baseline" }
[metrics]
want = ["r_light"]
[protocol]
contact = { clearance_mm = 0.3, search_mm = 0.5, speed_mm_s = 5.0, travel_mm_s = 50.0, settle_s = 0.01 }
calibration = { points = 4, indentations = 1, shear_mm = 0.0 }
lighting = { points = 2 }
"#;

#[test]
fn a_light_without_a_driver_is_set_by_hand_and_asked_for_by_its_name() {
    let (world, folder) = (World::new(), tempfile::tempdir().expect("a folder"));
    let path = folder.path().join("run");
    let refused = record_by_hand(&world, &path, &SilentProgress, (LIGHTS, None));
    let text = refused.expect_err("nobody is there").to_string();
    assert!(text.contains("2 lights are changed by hand"), "{text}");
    assert_eq!(world.state().readings, 0);

    let hands = Mutex::new(ScriptedOperator {
        asked: Vec::new(),
        answer: |_| Answer::Done,
    });
    let whole = record_by_hand(&world, &path, &SilentProgress, (LIGHTS, Some(&hands)));
    let whole = whole.expect("somebody sets the light");
    let held = hands.lock().expect("whole");
    let lights: Vec<&Question> = held
        .asked
        .iter()
        .filter(|question| matches!(question, Question::Light(_)))
        .collect();
    let light = |name: &str| Question::Light(name.to_owned());
    assert_eq!(lights, [&light("dark"), &light("lamp")]);
    assert!(!whole.table().samples().is_empty());
}
