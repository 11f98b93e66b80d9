//! A scripted test rig that records every motion.

use std::sync::{Arc, Mutex, MutexGuard};
use std::time::Duration;

use taceva_core::{
    Axes, Deadline, DriverError, DriverKey, ErrorKind, ForceTransducer, Halt, Millimetre, Newton,
    Point, Pose, Robot, Speed, Stamp, Tare, Wrench,
};

use super::bounds::Bounds;
use super::supervisor::{Observation, SharedSupervisor, Supervisor};
use super::time::{Cancel, Timekeeper};
use super::tip::{Pace, Tip};
use crate::limits::Overshoot;
use crate::plan::tests::bench::{SMALL, paper_metrics, rig_of, sensor};
use crate::plan::{Plan, plan_study};
use crate::scene::Scene;
use crate::source::SourceInfo;

/// Height of the gel surface, in mm. This and the following lengths are sums of powers of two, so that arithmetic with them is exact.
pub(super) const CONTACT_MM: f64 = 0.25;
pub(super) const SEGMENT_MM: f64 = 0.125;
pub(super) const CONTACT_MM_S: f64 = 4.0;
pub(super) const TRAVEL_MM_S: f64 = 16.0;

/// Function that returns the force in N for the number of the reading and the height of the tip; `None` for a timeout.
type Force = Box<dyn FnMut(u32, f64) -> Option<f64> + Send>;

/// Force in N of a working transducer without contact, for reading number `question`. No two readings are equal.
pub(super) fn nothing(question: u32, _: f64) -> Option<f64> {
    Some(f64::from(question) * 1e-6)
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Motion {
    pub(super) from_mm: f64,
    pub(super) to_mm: f64,
    pub(super) speed_mm_s: f64,
}

pub(super) struct State {
    pub(super) now_s: f64,
    pub(super) height_mm: f64,
    pub(super) halted: bool,
    /// True if the robot reports motions that it does not make.
    pub(super) stuck: bool,
    /// Distance by which the tip stops above each target, in mm.
    pub(super) lag_mm: f64,
    /// Number of next attempts to clear a halt that time out.
    pub(super) unheard: u32,
    /// Number of attempts to clear a halt.
    pub(super) readied: u32,
    /// Zero that the transducer has set itself, in N; `None` if it has set none.
    pub(super) box_zero_n: Option<f64>,
    /// Height in mm of an obstacle, and the supervisor to which a guard thread reports a touch of it once.
    pub(super) obstacle: Option<(f64, SharedSupervisor)>,
    questions: u32,
    force: Force,
    motions: Vec<Motion>,
}

#[derive(Clone)]
pub(super) struct Rig(Arc<Mutex<State>>);

impl Rig {
    pub(super) fn new(
        height_mm: f64,
        force: impl FnMut(u32, f64) -> Option<f64> + Send + 'static,
    ) -> Rig {
        Rig(Arc::new(Mutex::new(State {
            now_s: 5.0,
            height_mm,
            halted: true,
            stuck: false,
            lag_mm: 0.0,
            unheard: 0,
            readied: 0,
            box_zero_n: None,
            obstacle: None,
            questions: 0,
            force: Box::new(force),
            motions: Vec::new(),
        })))
    }

    pub(super) fn state(&self) -> MutexGuard<'_, State> {
        self.0.lock().expect("whole")
    }

    pub(super) fn motions(&self) -> Vec<Motion> {
        self.state().motions.clone()
    }
}

fn now(state: &State) -> Stamp {
    Stamp {
        valid_s: state.now_s,
        received_s: None,
    }
}

/// Force of an obstacle, in N.
const HARD_N: f64 = 1.0;

fn pressing(force_n: f64) -> Wrench {
    Wrench {
        force: [Newton(0.0), Newton(0.0), Newton(force_n)],
        ..Wrench::default()
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
        if let Some((height_mm, supervisor)) = state.obstacle.take_if(|(height, _)| to_mm > *height)
        {
            state.height_mm = height_mm;
            let (now_s, stamp) = (state.now_s, now(&state));
            drop(state);
            let felt = Observation::Force(pressing(HARD_N), stamp);
            let _ = supervisor.lock().observe(&felt, now_s);
            return Err(error(ErrorKind::Interrupted, "move"));
        }
        state.now_s += (to_mm - from_mm).abs() / speed_mm_s;
        if !state.stuck {
            state.height_mm = to_mm - state.lag_mm;
        }
        Ok(now(&state))
    }

    fn halt_handle(&self) -> Arc<dyn Halt> {
        Arc::new(self.clone())
    }

    fn clear_halt(&mut self, _: Deadline) -> Result<(), DriverError> {
        let mut state = self.state();
        state.readied += 1;
        if state.unheard > 0 {
            state.unheard -= 1;
            return Err(error(ErrorKind::Timeout, "end the halt"));
        }
        state.halted = false;
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
        let (question, height_mm) = (state.questions, state.height_mm);
        match (state.force)(question, height_mm) {
            Some(force_n) => {
                state.now_s += 0.001;
                let force_n = force_n - state.box_zero_n.unwrap_or(0.0);
                Ok((pressing(force_n), now(&state)))
            }
            None => {
                state.now_s += deadline.remaining().as_secs_f64();
                Err(error(ErrorKind::Timeout, "read"))
            }
        }
    }

    fn tare(&mut self) -> Option<&mut dyn Tare> {
        let has_tare = self.state().box_zero_n.is_some();
        if has_tare { Some(self) } else { None }
    }
}

impl Tare for Rig {
    fn zero(&mut self, _: Deadline) -> Result<(), DriverError> {
        let mut state = self.state();
        state.questions += 1;
        let (question, height_mm) = (state.questions, state.height_mm);
        state.box_zero_n = (state.force)(question, height_mm);
        Ok(())
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

/// Pseudo-random numbers from a seed.
pub(super) struct Draws(u64);

impl Draws {
    pub(super) fn new(seed: u64) -> Draws {
        Draws(seed.wrapping_add(1))
    }

    /// A uniformly distributed number from 0 to 1, by splitmix64.
    pub(super) fn fraction(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut mixed = self.0;
        mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let high = u32::try_from((mixed ^ (mixed >> 31)) >> 32).expect("32 bits");
        f64::from(high) / f64::from(u32::MAX)
    }

    /// A nearly normally distributed number: the sum of twelve uniform numbers.
    pub(super) fn normal(&mut self) -> f64 {
        (0..12).map(|_| self.fraction()).sum::<f64>() - 6.0
    }
}

/// Test plan with 2 mm of clearance and 1 mm of greatest depth. The overshoot is 0.25 mm and a segment 0.125 mm.
pub(super) fn plan() -> Plan {
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

/// Calls `act` with the tip of `rig`, which has touched the gel at [`CONTACT_MM`].
pub(super) fn with_tip<T>(rig: &Rig, act: impl FnOnce(&mut Tip<'_>) -> T) -> T {
    let plan = plan();
    let limits = plan.limits.clone().expect("it moves");
    let (mut robot, mut force, mut clock) = (rig.clone(), rig.clone(), rig.clone());
    let cancel = Cancel::new();
    let mut tip = Tip::new(
        &mut robot,
        &mut force,
        &mut clock,
        &cancel,
        SharedSupervisor::new(Supervisor::new(limits, Arc::new(rig.clone()))),
        Bounds::of(&plan, 0.0).expect("it moves"),
        Pace::of(&plan).expect("it moves"),
    );
    tip.contact_mm = Some(CONTACT_MM);
    act(&mut tip)
}
