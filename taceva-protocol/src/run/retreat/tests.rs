//! The way out motion by motion: how fast, how far, and what moves not at all.

use std::sync::{Arc, Mutex, MutexGuard};

use taceva_core::{
    Axes, Deadline, DriverError, DriverKey, ErrorKind, ForceTransducer, Halt, Newton, Robot, Speed,
    Stamp, Wrench,
};

use super::*;
use crate::limits::Overshoot;
use crate::plan::tests::bench::{SMALL, paper_metrics, rig_of, sensor};
use crate::plan::{Plan, plan_study};
use crate::run::bounds::Bounds;
use crate::run::supervisor::Supervisor;
use crate::run::time::{Cancel, Timekeeper};
use crate::run::tip::Pace;
use crate::scene::Scene;
use crate::source::SourceInfo;

/// The gel begins here; all lengths are parts of powers of two, so that sums of them are exact.
const CONTACT_MM: f64 = 0.25;
const SEGMENT_MM: f64 = 0.125;
const CONTACT_MM_S: f64 = 4.0;
const TRAVEL_MM_S: f64 = 16.0;

/// What the transducer says to each question; `None` is silence.
type Force = fn(question: u32) -> Option<f64>;

/// A live transducer that feels nothing: no two readings are equal.
fn nothing(question: u32) -> Option<f64> {
    Some(f64::from(question) * 1e-6)
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Motion {
    from_mm: f64,
    to_mm: f64,
    speed_mm_s: f64,
}

struct State {
    now_s: f64,
    height_mm: f64,
    halted: bool,
    questions: u32,
    force: Force,
    motions: Vec<Motion>,
}

#[derive(Clone)]
struct Rig(Arc<Mutex<State>>);

impl Rig {
    fn new(height_mm: f64, force: Force) -> Rig {
        Rig(Arc::new(Mutex::new(State {
            now_s: 5.0,
            height_mm,
            halted: true,
            questions: 0,
            force,
            motions: Vec::new(),
        })))
    }

    fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().expect("whole")
    }

    fn motions(&self) -> Vec<Motion> {
        self.state().motions.clone()
    }
}

fn now(state: &State) -> Stamp {
    Stamp {
        valid_s: state.now_s,
        received_s: None,
    }
}

fn error(kind: ErrorKind, what: &'static str) -> DriverError {
    DriverError::new(kind, &DriverKey::fixed("test/rig"), what)
}

impl Halt for Rig {
    fn halt(&self) -> Result<(), DriverError> {
        self.state().halted = true;
        Ok(())
    }
}

impl Robot for Rig {
    fn pose(&mut self, _: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let state = self.state();
        let position = Point {
            z: Millimetre(state.height_mm),
            ..Point::default()
        };
        let pose = Pose {
            position,
            ..Pose::default()
        };
        Ok((pose, now(&state)))
    }

    fn move_to(&mut self, target: Pose, speed: Speed, _: Deadline) -> Result<Stamp, DriverError> {
        let mut state = self.state();
        if state.halted {
            return Err(error(ErrorKind::Interrupted, "move"));
        }
        let (from_mm, to_mm) = (state.height_mm, target.position.z.0);
        let speed_mm_s = speed.mm_per_s();
        state.motions.push(Motion {
            from_mm,
            to_mm,
            speed_mm_s,
        });
        state.now_s += (to_mm - from_mm).abs() / speed_mm_s;
        state.height_mm = to_mm;
        Ok(now(&state))
    }

    fn halt_handle(&self) -> Arc<dyn Halt> {
        Arc::new(self.clone())
    }

    fn clear_halt(&mut self, _: Deadline) -> Result<(), DriverError> {
        self.state().halted = false;
        Ok(())
    }
}

impl ForceTransducer for Rig {
    fn axes(&self) -> Axes {
        Axes::FORCE
    }

    fn read(&mut self, deadline: Deadline) -> Result<(Wrench, Stamp), DriverError> {
        let mut state = self.state();
        state.questions += 1;
        match (state.force)(state.questions) {
            Some(force_n) => {
                state.now_s += 0.001;
                let force = [Newton(0.0), Newton(0.0), Newton(force_n)];
                let wrench = Wrench {
                    force,
                    ..Wrench::default()
                };
                Ok((wrench, now(&state)))
            }
            None => {
                state.now_s += deadline.remaining().as_secs_f64();
                Err(error(ErrorKind::Timeout, "read"))
            }
        }
    }
}

impl Timekeeper for Rig {
    fn now_s(&self) -> f64 {
        self.state().now_s
    }

    fn rest(&mut self, rest: Duration) {
        self.state().now_s += rest.as_secs_f64();
    }
}

/// 2 mm of clearance, 1 mm of depth and a quarter beyond it, in segments of an eighth.
fn plan() -> Plan {
    let scene = Scene::parse("small", SMALL).expect("a scene");
    let source = SourceInfo::Rig(Box::new(rig_of(sensor(), Axes::FORCE)));
    let plan = plan_study(&scene, &scene.studies[0], &source, &paper_metrics());
    let mut plan = plan.expect("a plan");
    plan.contact.clearance_mm.value = 2.0;
    plan.contact.speed_mm_s.value = CONTACT_MM_S;
    let limits = plan.limits.as_mut().expect("it moves");
    limits.depth_max = Millimetre(1.0);
    limits.normal_max = Newton(1.5);
    limits.speed_max_mm_s = TRAVEL_MM_S;
    limits.overshoot = Overshoot {
        segment_mm: SEGMENT_MM,
        healthy_mm: 0.25,
        frozen_mm: 1.0,
    };
    plan
}

/// Lets `act` move the tip of `rig`, which touched the gel at [`CONTACT_MM`].
fn with_tip<T>(rig: &Rig, act: impl FnOnce(&mut Tip<'_>) -> T) -> T {
    let plan = plan();
    let limits = plan.limits.clone().expect("it moves");
    let (mut robot, mut force, mut clock) = (rig.clone(), rig.clone(), rig.clone());
    let cancel = Cancel::new();
    let mut tip = Tip::new(
        (&mut robot, &mut force),
        (&mut clock, &cancel),
        Supervisor::new(limits, Arc::new(rig.clone())),
        (
            Bounds::of(&plan, 0.0).expect("it moves"),
            Pace::of(&plan).expect("it moves"),
        ),
    );
    tip.contact_mm = Some(CONTACT_MM);
    act(&mut tip)
}

#[test]
fn the_tip_leaves_the_gel_and_half_a_millimetre_above_it_slowly_and_only_then_fast() {
    let rig = Rig::new(1.0, nothing);
    with_tip(&rig, |tip| tip.retreat()).expect("nothing in the way");
    let motions = rig.motions();
    let (last, slow) = motions.split_last().expect("it moved");
    let fast = Motion {
        from_mm: CONTACT_MM - 0.5,
        to_mm: -2.0,
        speed_mm_s: TRAVEL_MM_S,
    };
    assert_eq!(*last, fast);
    assert_eq!(slow.len(), 10, "1.25 mm in eighths");
    for motion in slow {
        let way_mm = motion.from_mm - motion.to_mm;
        assert_eq!((way_mm, motion.speed_mm_s), (SEGMENT_MM, CONTACT_MM_S));
    }
}

#[test]
fn a_tip_in_the_air_already_goes_up_at_once() {
    for from_mm in [CONTACT_MM - 0.5, -0.5] {
        let rig = Rig::new(from_mm, nothing);
        with_tip(&rig, |tip| tip.retreat()).expect("nothing in the way");
        let up = Motion {
            from_mm,
            to_mm: -2.0,
            speed_mm_s: TRAVEL_MM_S,
        };
        assert_eq!(rig.motions(), [up]);
    }
}

#[test]
fn from_a_limit_of_depth_the_tip_draws_back_to_the_first_segment_at_which_it_may_rest() {
    // Half a millimetre too deep; a quarter may be left.
    let rig = Rig::new(CONTACT_MM + 1.5, nothing);
    with_tip(&rig, |tip| tip.draw_back(CONTACT_MM)).expect("nothing in the way");
    let ends: Vec<f64> = rig.motions().iter().map(|motion| motion.to_mm).collect();
    assert_eq!(ends, [CONTACT_MM + 1.375, CONTACT_MM + 1.25]);
}

#[test]
fn under_a_force_that_does_not_fall_the_tip_draws_back_to_the_first_contact_and_no_farther() {
    let rig = Rig::new(CONTACT_MM + 0.3125, |question| {
        Some(2.0 + f64::from(question) * 1e-6)
    });
    with_tip(&rig, |tip| tip.draw_back(CONTACT_MM)).expect("no more than it was");
    let ends: Vec<f64> = rig.motions().iter().map(|motion| motion.to_mm).collect();
    assert_eq!(ends, [CONTACT_MM + 0.1875, CONTACT_MM + 0.0625, CONTACT_MM]);
}

#[test]
fn after_a_fault_nothing_moves_while_the_force_is_the_same_to_the_last_bit() {
    let rig = Rig::new(1.0, |_| Some(0.5));
    assert!(!with_tip(&rig, |tip| tip.abandon()));
    assert_eq!(rig.motions(), []);
    assert!(rig.state().halted);
}

#[test]
fn after_a_fault_nothing_moves_while_the_transducer_is_silent() {
    let rig = Rig::new(1.0, |_| None);
    assert!(!with_tip(&rig, |tip| tip.abandon()));
    assert_eq!(rig.motions(), []);
    assert!(rig.state().halted);
}

#[test]
fn after_a_fault_the_tip_leaves_the_gel_as_soon_as_the_force_is_alive_again() {
    // Silence is believed after three questions, so that this is the third look.
    let rig = Rig::new(1.0, |question| nothing(question).filter(|_| question > 6));
    assert!(with_tip(&rig, |tip| tip.abandon()));
    let motions = rig.motions();
    let (first, last) = (motions[0], motions[motions.len() - 1]);
    assert_eq!((first.from_mm, first.speed_mm_s), (1.0, CONTACT_MM_S));
    assert_eq!((last.to_mm, last.speed_mm_s), (-2.0, TRAVEL_MM_S));
}
