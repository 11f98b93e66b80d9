//! Extension of a robot that stops by itself at a force limit.

use core::ffi::c_void;

use crate::device::Stamp;
use crate::error::Error;
use crate::robot::{Motion, Pose};
use crate::status::Status;

/// Id of this ability.
pub const GUARDED_MOTION: &str = "taceva.robot.guarded-motion/1";

/// `taceva_guarded_stop`: end of a guarded motion.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::ext::GuardedStop;
/// use taceva_abi::{Pose, Stamp};
/// let pose = Pose { x: 0.0, y: 0.0, z: 0.0008, qw: 1.0, qx: 0.0, qy: 0.0, qz: 0.0 };
/// let stop = GuardedStop { size: size_of::<GuardedStop>() as u32, is_guarded: 1, pose, stamp: Stamp::default() };
/// assert_eq!(stop.is_guarded, 1, "the force was reached before the target");
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct GuardedStop {
    /// Size of this struct, bytes.
    pub size: u32,
    /// 0: the tip arrived at the target; 1: the tip stopped at the force limit.
    pub is_guarded: u32,
    /// Pose of the tip at rest.
    pub pose: Pose,
    /// Time at which the tip came to rest.
    pub stamp: Stamp,
}

/// `taceva_guarded_motion_calls`: function of a robot that stops by itself at a force.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
///
/// ```
/// use taceva_abi::ext::GuardedMotionCalls;
/// let calls = GuardedMotionCalls { size: size_of::<GuardedMotionCalls>() as u32, reserved: 0, move_guarded: None };
/// assert!(calls.move_guarded.is_none(), "a host refuses a device that names this ability and lacks its function");
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct GuardedMotionCalls {
    /// Size of this struct, bytes.
    pub size: u32,
    /// Reserved, 0.
    pub reserved: u32,
    /// `[owner & open]` Moves the tip to the target, or until the magnitude of the force reaches the limit.
    pub move_guarded: Option<
        unsafe extern "C" fn(
            *mut c_void,
            *const Motion,
            guard_n: f64,
            *mut GuardedStop,
            timeout_ns: u64,
            *mut Error,
        ) -> Status,
    >,
}
