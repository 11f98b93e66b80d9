//! Tests that the robot is halted away from the gel while a changer moves, and tests of failing changers.

use taceva_core::{DriverError, DriverKey, ErrorKind};

use super::*;
use crate::run::operator::{Answer, Operator, Question};
use crate::run::rig::{CONTACT_MM, Rig, plan};
use crate::run::time::Cancel;
use crate::run::{Controls, Devices, Mode, RunSpec, SpecimenChanger};

/// Test changer that needs two seconds for a change. Records before and after the change the tip height and whether the robot is halted.
struct Carousel {
    rig: Rig,
    holds: bool,
    fails: bool,
    seen: Vec<(f64, bool, usize)>,
}

impl Carousel {
    fn look(&mut self) {
        let state = self.rig.state();
        let (height_mm, is_halted) = (state.height_mm, state.halted);
        drop(state);
        let motions = self.rig.motions().len();
        self.seen.push((height_mm, is_halted, motions));
    }
}

impl SpecimenChanger for Carousel {
    fn mount(&mut self, _: Specimen, deadline: Deadline) -> Result<(), DriverError> {
        assert_eq!(deadline.remaining(), PATIENCE);
        self.look();
        self.rig.state().now_s += 2.0;
        self.look();
        let key = DriverKey::fixed("lab/carousel");
        match self.fails {
            true => Err(DriverError::new(ErrorKind::DeviceFault, &key, "turn").because("stuck")),
            false => Ok(()),
        }
    }

    fn holds(&self, _: Specimen) -> bool {
        self.holds
    }

    fn patience(&self) -> Option<Duration> {
        Some(PATIENCE)
    }
}

const PATIENCE: Duration = Duration::from_secs(30);

/// Test operator who records the questions and gives a fixed answer.
struct Person(Answer, Vec<Question>);

impl Operator for Person {
    fn ask(&mut self, question: &Question, _: &Cancel) -> Answer {
        self.1.push(question.clone());
        self.0
    }
}

/// Outcome of mounting another specimen while the tip is 0.5 mm deep in the gel.
struct Outcome {
    skipped: Result<bool, RunError>,
    carousel: Carousel,
    rig: Rig,
    asked: Vec<Question>,
    is_mounted: bool,
}

fn needed(holds: bool, fails: bool, answer: Option<Answer>) -> Outcome {
    let mut rig = Rig::new(CONTACT_MM + 0.5, |question, height_mm| {
        let pressed_mm = (height_mm - CONTACT_MM).max(0.0);
        Some(0.5 * pressed_mm + f64::from(question) * 1e-6)
    });
    let mut plan = plan();
    for press in &mut plan.presses {
        press.frames = false;
    }
    let (mut force, mut clock, seen) = (rig.clone(), rig.clone(), rig.clone());
    let mut carousel = Carousel {
        rig: rig.clone(),
        holds,
        fails,
        seen: Vec::new(),
    };
    let cancel = Cancel::new();
    let mut person = answer.map(|answer| Person(answer, Vec::new()));
    let spec = RunSpec {
        plan: &plan,
        unit: &plan.presses[0].press.unit,
        mode: Mode::Acquire,
    };
    let devices = Devices {
        robot: &mut rig,
        force: &mut force,
        sensor: None,
        lighting: None,
        specimens: Some(&mut carousel),
    };
    let controls = Controls {
        clock: &mut clock,
        cancel: &cancel,
        events: &mut |_| {},
        operator: match &mut person {
            Some(person) => Some(person),
            None => None,
        },
    };
    let mut run = Run::new(&spec, devices, controls, None).expect("it begins");
    run.tip.release().expect("free");
    run.tip.find_pose().expect("it stands low");
    run.tip.contact_mm = Some(CONTACT_MM);
    let planned = plan.presses[0].clone();
    let skipped = run.is_skipped(&planned);
    let is_mounted = run.mounted == Some(planned.press.specimen);
    drop(run);
    Outcome {
        skipped,
        carousel,
        rig: seen,
        asked: person.map(|person| person.1).unwrap_or_default(),
        is_mounted,
    }
}

#[test]
fn the_robot_stands_halted_above_the_gel_for_as_long_as_the_changer_moves() {
    let left = needed(true, false, None);
    assert!(!left.skipped.expect("it is mounted") && left.is_mounted);
    let [begun, ended] = left.carousel.seen[..] else {
        panic!("{:?}", left.carousel.seen);
    };
    assert_eq!((begun.0, begun.1), (-2.0, true));
    assert_eq!(begun, ended);
    assert!(!left.rig.state().halted, "it may move on");
    assert!(left.asked.is_empty());
}

#[test]
fn a_changer_that_fails_ends_the_run_with_the_tip_halted_above_the_gel_where_nobody_is() {
    let left = needed(true, true, None);
    let error = left.skipped.expect_err("it is stuck");
    assert!(
        error.press.is_some() && error.to_string().contains("stuck"),
        "{error}"
    );
    assert_eq!(error.left, Left::Clear);
    let state = left.rig.state();
    assert!(state.halted && state.height_mm <= -2.0 && !left.is_mounted);
}

#[test]
fn a_changer_that_fails_is_out_of_use_and_somebody_mounts_by_hand() {
    let left = needed(true, true, Some(Answer::Done));
    assert!(!left.skipped.expect("by hand") && left.is_mounted);
    // Then the light.
    let [Question::Instead { why, .. }, Question::Light(_)] = &left.asked[..] else {
        panic!("{:?}", left.asked);
    };
    assert!(why.contains("stuck"), "{why}");
    assert_eq!(left.carousel.seen.len(), 2, "asked once");
    let left = needed(true, true, Some(Answer::Skip));
    assert!(left.skipped.expect("left out") && left.rig.state().halted);
}

#[test]
fn what_the_changer_does_not_hold_is_mounted_by_hand_or_ends_the_run() {
    let left = needed(false, false, Some(Answer::Done));
    assert!(!left.skipped.expect("by hand") && left.is_mounted);
    assert!(
        matches!(left.asked[0], Question::Mount(_)),
        "{:?}",
        left.asked
    );
    assert!(left.carousel.seen.is_empty());
    let left = needed(false, false, None);
    let error = left.skipped.expect_err("nobody is there");
    assert!(
        error
            .to_string()
            .contains("which the changer does not hold"),
        "{error}"
    );
    assert!(left.rig.motions().is_empty() && left.carousel.seen.is_empty());
}
