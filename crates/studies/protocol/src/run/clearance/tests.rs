//! Tests that the tip leaves the gel before an operator reaches in, and moves only with permission.

use std::sync::Arc;

use super::*;
use crate::run::rig::{CONTACT_MM, Rig, plan};
use crate::run::supervisor::{Enabling, Supervisor};

/// Test operator who records the questions, the height of the tip, and whether the tip had moved.
struct Person {
    rig: Rig,
    answer: Answer,
    asked: Vec<(Question, f64, usize)>,
}

impl Operator for Person {
    fn ask(&mut self, question: &Question, _: &Cancel) -> Answer {
        let height_mm = self.rig.state().height_mm;
        let moved = self.rig.motions().len();
        self.asked.push((question.clone(), height_mm, moved));
        self.answer
    }
}

/// Raises the tip of a `rig` without enabling switch; the operator answers `answer`.
fn raised(rig: &Rig, answer: Answer) -> (Result<bool, RunError>, Person) {
    raised_under(rig, answer, None)
}

/// Raises the tip of `rig`; the operator answers `answer`. `enabling` is the state of the enabling switch, if the rig has one.
fn raised_under(
    rig: &Rig,
    answer: Answer,
    enabling: Option<Enabling>,
) -> (Result<bool, RunError>, Person) {
    let plan = plan();
    let limits = plan.limits.clone().expect("it moves");
    let supervisor = SharedSupervisor::new(Supervisor::new(limits, Arc::new(rig.clone())));
    if let Some(enabling) = enabling {
        supervisor.lock().enabling(enabling);
    }
    let (mut robot, mut force, mut clock) = (rig.clone(), rig.clone(), rig.clone());
    let mut person = Person {
        rig: rig.clone(),
        answer,
        asked: Vec::new(),
    };
    let cancel = Cancel::new();
    let controls = Controls {
        clock: &mut clock,
        cancel: &cancel,
        events: &mut |_| {},
        operator: Some(&mut person),
    };
    let done = raise(
        &plan,
        &mut robot,
        &mut force,
        controls,
        supervisor,
        Some("lab/arm"),
        0.5,
    );
    (done, person)
}

/// Test rig with the tip at `height_mm` over a gel that pushes back below its surface. No two readings are equal.
fn over_a_gel(height_mm: f64) -> Rig {
    Rig::new(height_mm, |question, height_mm| {
        let pressed_mm = (height_mm - CONTACT_MM).max(0.0);
        Some(0.5 * pressed_mm + f64::from(question) * 1e-6)
    })
}

#[test]
fn a_tip_in_the_gel_is_let_move_then_raised_and_halted() {
    let rig = over_a_gel(CONTACT_MM + 0.5);
    let (done, person) = raised(&rig, Answer::Done);
    assert!(done.expect("raised"), "it stood low");
    let enable = Question::Enable {
        robot: "lab/arm".to_owned(),
        way: "straight up to 2 mm above the gel".to_owned(),
    };
    assert_eq!(person.asked, [(enable, CONTACT_MM + 0.5, 0)]);
    let state = rig.state();
    assert!(state.halted);
    assert!((state.height_mm + 2.0).abs() < 1e-12, "{}", state.height_mm);
    drop(state);
    assert!(
        rig.motions()
            .iter()
            .all(|motion| motion.to_mm < motion.from_mm)
    );
}

#[test]
fn without_a_yes_it_stays_where_it_is() {
    for answer in [Answer::Skip, Answer::Stop] {
        let rig = over_a_gel(CONTACT_MM + 0.5);
        let (done, _) = raised(&rig, answer);
        let error = done.expect_err("nobody let it move");
        assert!(matches!(error.cause, StopCause::Cancelled), "{error}");
        assert_eq!(error.left, Left::Untouched);
        assert!(rig.motions().is_empty() && rig.state().halted);
    }
}

#[test]
fn a_tip_that_is_high_enough_is_halted_where_it_is_and_nobody_is_asked() {
    for height_mm in [-2.0, -5.0] {
        let rig = over_a_gel(height_mm);
        rig.state().halted = false;
        let (done, person) = raised(&rig, Answer::Stop);
        assert!(!done.expect("it stands high"), "it moved");
        assert!(person.asked.is_empty() && rig.motions().is_empty());
        assert!(rig.state().halted);
    }
}

#[test]
fn a_tip_in_the_gel_stays_there_while_nobody_holds_the_enabling_switch() {
    for (enabling, is_expected) in [
        (
            Enabling::Released,
            (|cause| matches!(cause, StopCause::Unheld { .. })) as fn(_) -> bool,
        ),
        (Enabling::Lost, |cause| {
            matches!(cause, StopCause::Tripped(_))
        }),
    ] {
        let rig = over_a_gel(CONTACT_MM + 0.5);
        let (done, _) = raised_under(&rig, Answer::Done, Some(enabling));
        let error = done.expect_err("nobody holds it");
        assert_eq!(error.left, Left::Untouched);
        assert!(rig.motions().is_empty());
        assert!(is_expected(error.cause));
    }
    let rig = over_a_gel(CONTACT_MM + 0.5);
    let (done, _) = raised_under(&rig, Answer::Done, Some(Enabling::Held));
    assert!(done.expect("raised"), "it stood low");
}
