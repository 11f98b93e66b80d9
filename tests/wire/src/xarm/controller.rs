//! State of the control box, and the effects of commands.

use std::collections::VecDeque;
use std::sync::{Mutex, MutexGuard, PoisonError};

use taceva_core::{Speed, single};

use super::client::Push;
use super::joint_motion::JointMotion;
use super::kinematics::{ABOVE, Angles, angles_at, flange};
use super::line::Line;
use crate::base::Base;
use crate::bench::WallBench;
use crate::fault::ArmFault;
use crate::placement::Placement;

/// Emulated control box, shared by the servers of all ports.
#[derive(Debug)]
pub(super) struct Controller {
    pub(super) bench: WallBench,
    pub(super) firmware: [u32; 3],
    box_state: Mutex<BoxState>,
}

#[derive(Debug)]
struct BoxState {
    state: u8,
    mode: u8,
    error: u8,
    warning: u8,
    enabled: u8,
    /// Roll, pitch and yaw of the tool, rad. The rotation has no effect on the gel.
    turned: [f32; 3],
    /// Angles of the joints when they were last computed, rad.
    angles: Angles,
    waiting: VecDeque<Order>,
    /// Motion in progress.
    current: Option<Order>,
}

/// A motion to make, and the client to notify of its end.
#[derive(Debug)]
struct Order {
    pose: [f32; 6],
    /// Angles at the end of a motion of the joints, rad; `None` for other motions.
    angles: Option<Angles>,
    speed: Speed,
    push: Option<Push>,
}

/// A motion that a client wants.
struct Motion {
    pose: [f32; 6],
    angles: Option<Angles>,
    speed_mm_s: f64,
    is_only_checked: bool,
}

/// Reply to a requested motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Taken {
    /// The arm makes the motion, or sets an error or a warning because it cannot.
    Accepted,
    /// The motion was only checked. The field is the number of the error that would end it; 0 for none.
    Checked(u8),
    /// The arm may not move.
    Refused,
}

/// State of the box, as a status byte and a report contain it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Snapshot {
    pub(super) state: u8,
    pub(super) mode: u8,
    pub(super) error: u8,
    pub(super) warning: u8,
    pub(super) enabled: u8,
    pub(super) queued: u16,
    pub(super) pose: [f32; 6],
    /// Angles of the joints, rad.
    pub(super) angles: [f32; 6],
}

/// Number of the mode in which the arm accepts velocities of the tip.
const VELOCITY: u8 = 5;
pub(super) const READY: u8 = 2;
const MOVING: u8 = 1;
const PAUSED: u8 = 3;
const STOPPED: u8 = 4;
/// Number of the state in which the arm rejects motions until a client makes it ready.
const UNREADY: u8 = 5;
/// Bits of all six joints.
const ALL_JOINTS: u8 = 0b11_1111;
const EMERGENCY_STOP: u8 = 2;
const COLLISION: u8 = 31;
const BOUNDARY: u8 = 35;
const BAD_PARAMETER: u8 = 12;
/// Least and greatest speed of the tip, mm/s. Other speeds become the nearest of these.
pub(super) const SPEEDS_MM_S: [f64; 2] = [0.1, 1_000.0];
/// Least and greatest speed of a joint, rad/s.
pub(super) const JOINT_SPEEDS_RAD_S: [f64; 2] = [0.001, 3.0];
/// Minimum duration of a motion of the joints, s, because joints may turn without moving the tip. In such a motion, the tip has at least
/// `TURN_MIN_MM_S`, mm/s.
const TURN_MIN_S: f64 = 1e-3;
const TURN_MIN_MM_S: f64 = 1e-3;
/// Safety boundary: range of the tip about the centre of the gel, mm.
const BOUNDARY_MM: [[f64; 2]; 3] = [[-60.0, 60.0], [-60.0, 60.0], [-100.0, 30.0]];

impl Controller {
    pub(super) fn new(bench: WallBench, firmware: [u32; 3]) -> Controller {
        Controller {
            bench,
            firmware,
            box_state: Mutex::new(BoxState {
                state: READY,
                mode: 0,
                error: 0,
                warning: 0,
                enabled: ALL_JOINTS,
                turned: [std::f32::consts::PI, 0.0, 0.0],
                angles: ABOVE,
                waiting: VecDeque::new(),
                current: None,
            }),
        }
    }

    /// True if messages for straight motions have the longer layout, as in new firmware.
    pub(super) fn takes_long_lines(&self) -> bool {
        self.firmware >= [1, 11, 100]
    }

    pub(super) fn snapshot(&self) -> Snapshot {
        self.turn();
        let mut inside = self.inside();
        let pose = self.pose(&inside);
        if let Some(angles) = angles_at(&Placement::of_pose(pose), inside.angles) {
            inside.angles = angles;
        }
        Snapshot {
            state: inside.state,
            mode: inside.mode,
            error: inside.error,
            warning: inside.warning,
            enabled: inside.enabled,
            queued: u16::try_from(inside.waiting.len() + usize::from(inside.current.is_some()))
                .unwrap_or(u16::MAX),
            pose,
            angles: inside.angles.map(single),
        }
    }

    fn pose(&self, inside: &BoxState) -> [f32; 6] {
        let position = self.bench.pose().position;
        let [x, y, z] = Base::to_base([position.x.0, position.y.0, position.z.0]).map(single);
        let [roll, pitch, yaw] = inside.turned;
        [x, y, z, roll, pitch, yaw]
    }

    /// Ends a completed motion and begins the next.
    pub(super) fn turn(&self) {
        let mut inside = self.inside();
        if inside.state != MOVING || self.bench.is_moving() {
            return;
        }
        if let Some(done) = inside.current.take() {
            inside.turned = [done.pose[3], done.pose[4], done.pose[5]];
            inside.angles = done.angles.unwrap_or(inside.angles);
            if let Some(push) = done.push {
                push.send(Push::SUCCEEDED);
            }
        }
        match inside.waiting.pop_front() {
            Some(next) => self.begin(&mut inside, next),
            None => inside.state = READY,
        }
    }

    /// Accepts, checks or rejects a straight motion.
    pub(super) fn take(&self, line: &Line, push: Option<Push>) -> Taken {
        let mut inside = self.inside();
        let last = inside.waiting.back().or(inside.current.as_ref());
        let from = last.map_or_else(|| self.pose(&inside), |order| order.pose);
        let [least, most] = SPEEDS_MM_S;
        let speed_mm_s = f64::from(line.speed_mm_s).clamp(least, most);
        let motion = Motion {
            pose: line.end(from),
            angles: None,
            speed_mm_s,
            is_only_checked: line.is_only_checked,
        };
        self.accept(&mut inside, motion, push)
    }

    /// Accepts a motion of the joints. The tip goes straight to the pose of the target angles, in the time of the slowest joint.
    pub(super) fn turn_joints(&self, motion: &JointMotion, push: Option<Push>) -> Taken {
        self.snapshot();
        let mut inside = self.inside();
        let last = inside.waiting.back().or(inside.current.as_ref());
        let from = last.map_or_else(|| self.pose(&inside), |order| order.pose);
        let from = Placement::of_pose(from);
        let before = last.and_then(|order| order.angles);
        let before = before.or_else(|| angles_at(&from, inside.angles));
        let before = before.unwrap_or(inside.angles);
        let angles = motion.end(before);
        let ways = angles
            .iter()
            .zip(before)
            .map(|(end, from)| (end - from).abs());
        let [least, most] = JOINT_SPEEDS_RAD_S;
        let speed_rad_s = f64::from(motion.speed_rad_s).clamp(least, most);
        let lasts_s = (ways.fold(0.0, f64::max) / speed_rad_s).max(TURN_MIN_S);
        let end = flange(angles);
        let [x, y, z, ..] = from.apart(&end);
        let speed_mm_s = x.hypot(y).hypot(z) / lasts_s;
        let motion = Motion {
            pose: end.pose(),
            angles: Some(angles),
            speed_mm_s: speed_mm_s.max(TURN_MIN_MM_S),
            is_only_checked: motion.is_only_checked,
        };
        self.accept(&mut inside, motion, push)
    }

    fn accept(&self, inside: &mut BoxState, motion: Motion, push: Option<Push>) -> Taken {
        let can_move = inside.error == 0
            && inside.mode == 0
            && inside.enabled == ALL_JOINTS
            && inside.state < STOPPED;
        if !can_move {
            return Taken::Refused;
        }
        let Motion { pose, angles, .. } = motion;
        let speed = Speed::try_new(motion.speed_mm_s);
        let (true, Ok(speed)) = (pose.iter().all(|side| side.is_finite()), speed) else {
            inside.warning = BAD_PARAMETER;
            return Taken::Accepted;
        };
        let place = Base::to_sensor([pose[0], pose[1], pose[2]].map(f64::from));
        let is_inside = place
            .iter()
            .zip(BOUNDARY_MM)
            .all(|(side, [least, most])| (least..=most).contains(side));
        if motion.is_only_checked {
            return Taken::Checked(if is_inside { 0 } else { BOUNDARY });
        }
        if !is_inside {
            self.fail(inside, BOUNDARY);
            return Taken::Accepted;
        }
        let order = Order {
            pose,
            angles,
            speed,
            push,
        };
        if inside.current.is_some() || inside.state == PAUSED {
            inside.waiting.push_back(order);
        } else {
            self.begin(inside, order);
        }
        Taken::Accepted
    }

    /// Accepts a velocity in mm/s of the base frame for `duration_s`; `false` if the arm may not move.
    pub(super) fn cruise(&self, velocity_mm_s: [f64; 3], duration_s: f64) -> bool {
        let mut inside = self.inside();
        let can_move = inside.error == 0
            && inside.mode == VELOCITY
            && inside.enabled == ALL_JOINTS
            && inside.state < STOPPED;
        if !can_move {
            return false;
        }
        let [x, y, z] = velocity_mm_s;
        let at = self.pose(&inside);
        self.bench.stand();
        let speed = Speed::try_new(x.hypot(y).hypot(z));
        let (Ok(speed), true) = (speed, duration_s > 0.0) else {
            inside.current = None;
            inside.state = READY;
            return true;
        };
        let mut pose = at;
        for (side, velocity_mm_s) in pose.iter_mut().zip(velocity_mm_s) {
            *side += single(velocity_mm_s * duration_s);
        }
        let order = Order {
            pose,
            angles: None,
            speed,
            push: None,
        };
        self.begin(&mut inside, order);
        true
    }

    fn begin(&self, inside: &mut BoxState, order: Order) {
        let [x, y, z, .., yaw] = order.pose.map(f64::from);
        self.bench.set_out(Base::pose([x, y, z], yaw), order.speed);
        inside.state = MOVING;
        inside.current = Some(order);
    }

    /// Stops and clears every motion.
    fn forget(&self, inside: &mut BoxState) {
        self.bench.stand();
        let given_up = inside.current.take().into_iter();
        for order in given_up.chain(inside.waiting.drain(..)) {
            if let Some(push) = order.push {
                push.send(Push::DISCARDED);
            }
        }
    }

    fn fail(&self, inside: &mut BoxState, error: u8) {
        self.forget(inside);
        inside.error = error;
        inside.state = STOPPED;
    }

    pub(super) fn set_state(&self, wanted: u8) {
        let mut inside = self.inside();
        match wanted {
            0 if inside.error == 0 && inside.enabled == ALL_JOINTS => {
                if inside.state == PAUSED
                    && let Some(order) = inside.current.take()
                {
                    self.begin(&mut inside, order);
                } else if inside.state != MOVING {
                    inside.state = READY;
                }
            }
            3 if inside.state == MOVING => {
                self.bench.stand();
                inside.state = PAUSED;
            }
            4 | 6 => {
                self.forget(&mut inside);
                inside.state = STOPPED;
            }
            _ => {}
        }
    }

    pub(super) fn set_mode(&self, mode: u8) {
        let mut inside = self.inside();
        self.forget(&mut inside);
        inside.mode = mode;
        inside.state = UNREADY;
    }

    pub(super) fn enable(&self, is_on: bool) {
        let mut inside = self.inside();
        self.forget(&mut inside);
        inside.enabled = if is_on { ALL_JOINTS } else { 0 };
        inside.state = UNREADY;
    }

    pub(super) fn clear_error(&self) {
        let mut inside = self.inside();
        self.forget(&mut inside);
        inside.error = 0;
        inside.state = UNREADY;
    }

    pub(super) fn clear_warning(&self) {
        self.inside().warning = 0;
    }

    pub(super) fn suffer(&self, fault: ArmFault) {
        let mut inside = self.inside();
        match fault {
            ArmFault::EmergencyStop => {
                self.fail(&mut inside, EMERGENCY_STOP);
                inside.enabled = 0;
            }
            ArmFault::Collision => self.fail(&mut inside, COLLISION),
        }
    }

    fn inside(&self) -> MutexGuard<'_, BoxState> {
        self.box_state
            .lock()
            .unwrap_or_else(PoisonError::into_inner)
    }
}
