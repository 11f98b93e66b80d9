//! Robot of a plugin.

#![expect(
    unsafe_code,
    reason = "a robot is moved through the plugin's functions"
)]

use std::ffi::c_void;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use taceva_abi as abi;
use taceva_abi::ext::{EXPIRING_MOTION, ExpiringMotionCalls, GUARDED_MOTION, GuardedMotionCalls};
use taceva_core::{
    Deadline, DriverError, DriverKey, DriverKind, ErrorKind, ExpiringMotion, Facts, Guard,
    GuardedMotion, GuardedStop, Halt, Pose, Robot, RobotFacts, SiPose, Speed, Stamp, check_pose,
};

use super::handle::{Handle, Opened, Owned, PluginDevice};
use super::sensor::stamp;
use crate::call::{Failure, call, timeout};

/// Robot of a plugin in this process.
pub(crate) struct PluginRobot {
    handle: Owned,
    functions: Functions,
    halt: Arc<Halter>,
    guarded: Option<GuardedAbility>,
    expiring: Option<ExpiringAbility>,
}

struct Functions {
    pose: unsafe extern "C" fn(
        *mut c_void,
        *mut abi::Pose,
        *mut abi::Stamp,
        u64,
        *mut abi::Error,
    ) -> abi::Status,
    move_to: unsafe extern "C" fn(
        *mut c_void,
        *const abi::Motion,
        *mut u64,
        *mut abi::Error,
    ) -> abi::Status,
    wait: unsafe extern "C" fn(
        *mut c_void,
        u64,
        *mut abi::Stamp,
        u64,
        *mut abi::Error,
    ) -> abi::Status,
    clear_halt: unsafe extern "C" fn(*mut c_void, u64, *mut abi::Error) -> abi::Status,
}

const OPENING: &str = "open the robot";
const MOVING: &str = "move";

impl PluginDevice for PluginRobot {
    const KIND: DriverKind = DriverKind::Robot;
    type Calls = abi::RobotCalls;
    type Facts = RobotFacts;

    fn facts(facts: &Facts) -> Option<&RobotFacts> {
        match facts {
            Facts::Robot(facts) => Some(facts),
            _ => None,
        }
    }

    fn new(
        opened: Opened<abi::RobotCalls>,
        facts: &RobotFacts,
    ) -> Result<PluginRobot, DriverError> {
        let Opened { handle, calls } = opened;
        let functions = Functions {
            pose: handle.needs(calls.pose, "pose")?,
            move_to: handle.needs(calls.move_to, "move_to")?,
            wait: handle.needs(calls.wait, "wait")?,
            clear_halt: handle.needs(calls.clear_halt, "clear_halt")?,
        };
        let halt = Arc::new(Halter {
            halt: handle.needs(calls.halt, "halt")?,
            handle: handle.share(),
            facts: *facts,
            is_halted: AtomicBool::new(false),
        });
        let guarded = if facts.guarded_motion {
            let stops = "it declares that it stops at a force";
            let move_guarded = |table: GuardedMotionCalls| table.move_guarded;
            Some(GuardedAbility {
                halt: Arc::clone(&halt),
                move_guarded: handle.ability(GUARDED_MOTION, OPENING, stops, move_guarded)?,
            })
        } else {
            None
        };
        let expiring = handle.extension::<ExpiringMotionCalls>(EXPIRING_MOTION, OPENING)?;
        let expiring = match expiring {
            None => None,
            Some(table) => Some(ExpiringAbility {
                halt: Arc::clone(&halt),
                move_expiring: handle.needs(table.move_expiring, "move_expiring")?,
            }),
        };
        Ok(PluginRobot {
            handle,
            functions,
            halt,
            guarded,
            expiring,
        })
    }
}

impl Robot for PluginRobot {
    fn pose(&mut self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        const DOING: &str = "read the pose";
        let mut pose = NOWHERE;
        let mut when = abi::Stamp::default();
        self.handle.call(DOING, |raw, error| {
            let (pose, when) = (&raw mut pose, &raw mut when);
            // SAFETY: [owner & open] by `&mut self`, with places for the answer and an error that outlive the call.
            unsafe { (self.functions.pose)(raw, pose, when, timeout(deadline), error) }
        })?;
        Ok((from_si(pose, self.handle.driver(), DOING)?, stamp(when)))
    }

    fn move_to(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let motion = self.halt.motion(target, speed)?;
        let mut token = 0;
        self.handle.call(MOVING, |raw, error| {
            // SAFETY: [owner & open] by `&mut self`, with a motion, a place for the token and an error that outlive the call.
            unsafe { (self.functions.move_to)(raw, &raw const motion, &raw mut token, error) }
        })?;
        let mut when = abi::Stamp::default();
        self.handle.call(MOVING, |raw, error| {
            // SAFETY: [owner & open] by `&mut self`, with a place for the stamp and an error that outlive the call.
            unsafe { (self.functions.wait)(raw, token, &raw mut when, timeout(deadline), error) }
        })?;
        Ok(stamp(when))
    }

    fn halt_handle(&self) -> Arc<dyn Halt> {
        Arc::clone(&self.halt) as Arc<dyn Halt>
    }

    fn clear_halt(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        self.handle.call("clear the halt", |raw, error| {
            // SAFETY: [owner & open] by `&mut self`, with an error that outlives the call.
            unsafe { (self.functions.clear_halt)(raw, timeout(deadline), error) }
        })?;
        self.halt.is_halted.store(false, Ordering::Release);
        Ok(())
    }

    fn guarded_motion(&mut self) -> Option<&mut dyn GuardedMotion> {
        let guarded = self.guarded.as_mut()?;
        Some(guarded)
    }

    fn expiring_motion(&mut self) -> Option<&mut dyn ExpiringMotion> {
        let expiring = self.expiring.as_mut()?;
        Some(expiring)
    }
}

/// Pose of NaNs. It detects a plugin that reports success without writing a pose.
const NOWHERE: abi::Pose = abi::Pose {
    x: f64::NAN,
    y: f64::NAN,
    z: f64::NAN,
    qw: f64::NAN,
    qx: f64::NAN,
    qy: f64::NAN,
    qz: f64::NAN,
};

fn from_si(pose: abi::Pose, driver: &DriverKey, doing: &'static str) -> Result<Pose, DriverError> {
    let si = SiPose {
        position_m: [pose.x, pose.y, pose.z],
        quaternion: [pose.qw, pose.qx, pose.qy, pose.qz],
    };
    si.to_pose().ok_or_else(|| {
        let why = format!(
            "a pose at {:?} m turned by {:?}, expected finite numbers and a unit quaternion",
            si.position_m, si.quaternion
        );
        Failure::new(ErrorKind::DeviceFault, why).of(driver, doing)
    })
}

/// Halts a robot from any thread. Records the halt even if the call of the plugin fails.
struct Halter {
    handle: Arc<Handle>,
    halt: unsafe extern "C" fn(*mut c_void, *mut abi::Error) -> abi::Status,
    facts: RobotFacts,
    is_halted: AtomicBool,
}

impl Halt for Halter {
    fn halt(&self) -> Result<(), DriverError> {
        self.is_halted.store(true, Ordering::Release);
        let halted = self.handle.call_beside(|raw| {
            // SAFETY: [any & open]: `call_beside` keeps the device open meanwhile; the error outlives the call.
            call(|error| unsafe { (self.halt)(raw, error) })
        });
        match halted {
            Some(Err(failure)) => Err(failure.of(self.handle.driver(), "halt")),
            Some(Ok(())) | None => Ok(()),
        }
    }
}

impl Halter {
    /// Creates the motion to `target`. Fails if the robot is halted or the motion exceeds its declared limits.
    fn motion(&self, target: Pose, speed: Speed) -> Result<abi::Motion, DriverError> {
        let refused = |kind, why: String| Failure::new(kind, why).of(self.handle.driver(), MOVING);
        check_pose(&target)
            .map_err(|error| refused(ErrorKind::InvalidArgument, error.to_string()))?;
        let workspace = self.facts.workspace;
        if let Some(workspace) = workspace.filter(|within| !within.contains(&target.position)) {
            let why = format!("{} is outside the workspace {workspace}", target.position);
            return Err(refused(ErrorKind::OutOfRange, why));
        }
        if let Some(most) = self.facts.speed_max.filter(|most| speed > *most) {
            let why = format!("a speed of {speed}, expected at most {most}");
            return Err(refused(ErrorKind::OutOfRange, why));
        }
        if self.is_halted.load(Ordering::Acquire) {
            let why = "it was halted: clear the halt before it moves again".to_owned();
            return Err(refused(ErrorKind::Interrupted, why));
        }
        let SiPose {
            position_m: [x, y, z],
            quaternion: [qw, qx, qy, qz],
        } = target.into();
        Ok(abi::Motion {
            size: u32::try_from(size_of::<abi::Motion>()).expect("a small struct"),
            reserved: 0,
            target: abi::Pose {
                x,
                y,
                z,
                qw,
                qx,
                qy,
                qz,
            },
            speed_m_per_s: speed.metres_per_second(),
        })
    }
}

struct GuardedAbility {
    halt: Arc<Halter>,
    move_guarded: unsafe extern "C" fn(
        *mut c_void,
        *const abi::Motion,
        f64,
        *mut abi::ext::GuardedStop,
        u64,
        *mut abi::Error,
    ) -> abi::Status,
}

impl GuardedMotion for GuardedAbility {
    fn move_guarded(
        &mut self,
        target: Pose,
        speed: Speed,
        guard: Guard,
        deadline: Deadline,
    ) -> Result<GuardedStop, DriverError> {
        const DOING: &str = "move until a force";
        let handle = &self.halt.handle;
        if !(guard.force.0 > 0.0 && guard.force.0.is_finite()) {
            let why = format!("a force limit of {}, expected one above 0", guard.force);
            let refused = Failure::new(ErrorKind::InvalidArgument, why);
            return Err(refused.of(handle.driver(), DOING));
        }
        let motion = self.halt.motion(target, speed)?;
        let mut stop = abi::ext::GuardedStop {
            size: u32::try_from(size_of::<abi::ext::GuardedStop>()).expect("a small struct"),
            is_guarded: u32::MAX,
            pose: NOWHERE,
            stamp: abi::Stamp::default(),
        };
        handle.call(DOING, |raw, error| {
            let (motion, stop) = (&raw const motion, &raw mut stop);
            let timeout = timeout(deadline);
            // SAFETY: [owner & open] by `&mut self`, which is borrowed from the robot, with a motion, a place for the stop and an error
            // that outlive the call.
            unsafe { (self.move_guarded)(raw, motion, guard.force.0, stop, timeout, error) }
        })?;
        let stamp = stamp(stop.stamp);
        match stop.is_guarded {
            0 => Ok(GuardedStop::Arrived { stamp }),
            1 => Ok(GuardedStop::Guarded {
                pose: from_si(stop.pose, handle.driver(), DOING)?,
                stamp,
            }),
            other => {
                let why = format!("`is_guarded` is {other}, expected 0 or 1");
                Err(Failure::new(ErrorKind::Abi, why).of(handle.driver(), DOING))
            }
        }
    }
}

struct ExpiringAbility {
    halt: Arc<Halter>,
    move_expiring: unsafe extern "C" fn(
        *mut c_void,
        *const abi::Motion,
        *mut abi::Stamp,
        u64,
        *mut abi::Error,
    ) -> abi::Status,
}

impl ExpiringMotion for ExpiringAbility {
    fn move_expiring(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        let motion = self.halt.motion(target, speed)?;
        let mut when = abi::Stamp::default();
        self.halt.handle.call(MOVING, |raw, error| {
            let (motion, when) = (&raw const motion, &raw mut when);
            // SAFETY: [owner & open] by `&mut self`, which is borrowed from the robot, with a motion, a place for the stamp and an error
            // that outlive the call.
            unsafe { (self.move_expiring)(raw, motion, when, timeout(deadline), error) }
        })?;
        Ok(stamp(when))
    }
}
