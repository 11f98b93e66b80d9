//! Tests of manual steps: nothing moves during a step, and the answers yes, no and stop have their effects.

use std::sync::{Arc, Mutex};

use taceva_core::{Fault, Specimen};

use super::bench::{Bench, Memory, SOFT};
use crate::simulation::fault::{FaultKind, Faults};
use crate::simulation::scenario::planned_scene;
use crate::simulation::world_handle::Shared;
use taceva_protocol::{Answer, Cancel, Event, Left, Mode, Operator, Question, StopCause};

const SCENE: &str = r#"
scene_version = 1
name = "boards"
sensor = { driver = "faults/sensor" }
robot = { driver = "faults/robot" }
force = { driver = "faults/force" }
model = { name = "ridge" }
[protocol]
contact = { clearance_mm = 0.5, search_mm = 1.0 }
calibration = { points = 3, indentations = 1 }
"#;

type Asked = Arc<Mutex<Vec<Question>>>;

/// Test operator that answers with a function and stores the questions. Checks that the robot is halted during a question.
struct ScriptedOperator {
    world: Shared,
    asked: Asked,
    answer: fn(&Shared, &Question) -> Answer,
}

impl Operator for ScriptedOperator {
    fn ask(&mut self, question: &Question, _: &Cancel) -> Answer {
        let is_fault = matches!(question, Question::Acknowledge(_));
        assert!(self.world.world().halted || is_fault, "hands are in");
        self.asked.lock().expect("whole").push(question.clone());
        (self.answer)(&self.world, question)
    }
}

/// A bench with two specimens, whose operator answers with `answer`. Also returns the list of questions.
fn bench(answer: fn(&Shared, &Question) -> Answer) -> (Bench, Asked) {
    let mut plan = planned_scene(SCENE, 1, &SOFT).expect("a plan");
    let other = Specimen::Sphere {
        radius: taceva_core::Nanometre(5_000_000),
    };
    let last = plan.presses.last_mut().expect("presses");
    last.press.specimen = other;
    let mut bench = Bench::with(SOFT, plan);
    let asked = Asked::default();
    bench.operator = Some(Box::new(ScriptedOperator {
        world: bench.shared.clone(),
        asked: Arc::clone(&asked),
        answer,
    }));
    (bench, asked)
}

fn done(_: &Shared, _: &Question) -> Answer {
    Answer::Done
}

#[test]
fn every_specimen_is_asked_for_once_and_mounted_while_the_robot_is_halted() {
    let (mut bench, asked) = bench(done);
    let report = bench
        .run(Mode::Acquire, &mut Memory::default())
        .expect("hands");
    assert_eq!((report.made, report.skipped), (bench.plan.presses.len(), 0));
    let expected = [0, bench.plan.presses.len() - 1]
        .map(|place| Question::Mount(bench.plan.presses[place].press.specimen));
    assert_eq!(*asked.lock().expect("whole"), expected);
    let mounted = bench
        .events
        .iter()
        .filter(|event| matches!(event, Event::Mounted(_)));
    assert_eq!(mounted.count(), 2);
}

#[test]
fn what_is_skipped_is_left_for_another_run_and_everything_else_is_made() {
    let (mut bench, asked) = bench(|_, question| match question {
        Question::Mount(Specimen::Sphere { radius }) if radius.0 == 5_000_000 => Answer::Skip,
        _ => Answer::Done,
    });
    let mut log = Memory::default();
    let error = bench.run(Mode::Acquire, &mut log).expect_err("one is left");
    assert!(
        matches!(error.cause, StopCause::Skipped { presses: 1 }),
        "{error}"
    );
    assert_eq!(error.left, Left::Clear);
    assert_eq!(log.records.len(), bench.plan.presses.len() - 1);
    assert_eq!(asked.lock().expect("whole").len(), 2);
}

/// Like [`bench`], but with one specimen, and a light that the operator must set for the middle press.
fn with_a_skipped_light(answer: fn(&Shared, &Question) -> Answer) -> (Bench, Asked) {
    let (mut bench, asked) = bench(answer);
    let presses = &mut bench.plan.presses;
    let specimen = presses[0].press.specimen;
    for planned in presses.iter_mut() {
        planned.press.specimen = specimen;
    }
    let middle = presses.len() / 2;
    presses[middle].press.light = Some("S1".to_owned());
    assert!((1..presses.len() - 1).contains(&middle));
    (bench, asked)
}

#[test]
fn after_a_skip_nothing_moves_before_somebody_lets_the_robot_go_on() {
    let (mut bench, asked) = with_a_skipped_light(|_, question| match question {
        Question::Light(_) => Answer::Skip,
        _ => Answer::Done,
    });
    let mut log = Memory::default();
    let error = bench.run(Mode::Acquire, &mut log).expect_err("one is left");
    assert!(
        matches!(error.cause, StopCause::Skipped { presses: 1 }),
        "{error}"
    );
    assert_eq!(log.records.len(), bench.plan.presses.len() - 1);
    let specimen = bench.plan.presses[0].press.specimen;
    let light = Question::Light("S1".to_owned());
    let expected = [Question::Mount(specimen), light, Question::GoOn];
    assert_eq!(*asked.lock().expect("whole"), expected);
    assert_eq!(bench.shared.world().oracle.violations, []);
}

#[test]
fn who_skips_and_does_not_let_the_robot_go_on_ends_the_run_with_every_press_before() {
    let (mut bench, _) = with_a_skipped_light(|_, question| match question {
        Question::Light(_) => Answer::Skip,
        Question::GoOn => Answer::Stop,
        _ => Answer::Done,
    });
    let mut log = Memory::default();
    let error = bench.run(Mode::Acquire, &mut log).expect_err("stopped");
    assert!(matches!(error.cause, StopCause::Cancelled), "{error}");
    let middle = bench.plan.presses.len() / 2;
    assert_eq!((error.left, log.records.len()), (Left::Clear, middle));
}

#[test]
fn who_stops_when_asked_ends_the_run_above_the_gel() {
    let (mut bench, _) = bench(|_, _| Answer::Stop);
    let mut log = Memory::default();
    let error = bench.run(Mode::Acquire, &mut log).expect_err("stopped");
    assert!(matches!(error.cause, StopCause::Cancelled), "{error}");
    assert_eq!((error.left, log.records.len()), (Left::Clear, 0));
}

#[test]
fn a_fault_that_somebody_acknowledges_at_the_robot_costs_the_press_alone() {
    let (mut bench, asked) = bench(|world, question| {
        if let Question::Acknowledge(_) = question {
            world.world().acknowledge();
        }
        Answer::Done
    });
    bench.shared.world().faults = Faults::from(FaultKind::EmergencyStop, 8.0);
    let mut log = Memory::default();
    let report = bench.run(Mode::Acquire, &mut log).expect("acknowledged");
    assert_eq!(report.made, bench.plan.presses.len());
    let question = Question::Acknowledge(Fault::EmergencyStop);
    assert_eq!(
        asked
            .lock()
            .expect("whole")
            .iter()
            .filter(|asked| **asked == question)
            .count(),
        1
    );
    assert_eq!(bench.shared.world().oracle.violations, []);
}

#[test]
fn a_fault_that_nobody_acknowledges_ends_the_run_where_the_tip_stands() {
    let (mut bench, _) = bench(|_, question| match question {
        Question::Acknowledge(_) => Answer::Stop,
        _ => Answer::Done,
    });
    bench.shared.world().faults = Faults::from(FaultKind::EmergencyStop, 8.0);
    let error = bench
        .run(Mode::Acquire, &mut Memory::default())
        .expect_err("stopped");
    assert_eq!(error.cause.fault(), Some(Fault::EmergencyStop));
    assert_eq!(error.left, Left::InPlace);
    assert_eq!(bench.shared.world().oracle.violations, []);
}
