//! The calls of a robot.

use core::ffi::c_void;

use crate::device::{DeviceCalls, Stamp};
use crate::error::Error;
use crate::status::Status;

/// `taceva_pose`: the tip in the sensor's frame, m and a unit quaternion.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Pose {
    /// m.
    pub x: f64,
    /// m.
    pub y: f64,
    /// m, into the gel.
    pub z: f64,
    /// The real part.
    pub qw: f64,
    /// About x.
    pub qx: f64,
    /// About y.
    pub qy: f64,
    /// About z.
    pub qz: f64,
}

/// `taceva_motion`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Motion {
    /// Of this struct.
    pub size: u32,
    /// 0.
    pub reserved: u32,
    /// Where to.
    pub target: Pose,
    /// Along the path of the tip.
    pub speed_m_per_s: f64,
}

/// `taceva_robot_calls`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct RobotCalls {
    /// What every device has.
    pub device: DeviceCalls,
    /// `[owner & open]`
    pub pose: Option<
        unsafe extern "C" fn(
            *mut c_void,
            *mut Pose,
            *mut Stamp,
            timeout_ns: u64,
            *mut Error,
        ) -> Status,
    >,
    /// `[owner & open]` Returns when accepted; may leave the motion to `wait`.
    pub move_to: Option<
        unsafe extern "C" fn(*mut c_void, *const Motion, token: *mut u64, *mut Error) -> Status,
    >,
    /// `[owner & open]` Until the tip rests at the target.
    pub wait: Option<
        unsafe extern "C" fn(
            *mut c_void,
            token: u64,
            *mut Stamp,
            timeout_ns: u64,
            *mut Error,
        ) -> Status,
    >,
    /// `[any & open]` At rest within 50 ms; idempotent.
    pub halt: Option<unsafe extern "C" fn(*mut c_void, *mut Error) -> Status>,
    /// `[owner & open]`
    pub clear_halt:
        Option<unsafe extern "C" fn(*mut c_void, timeout_ns: u64, *mut Error) -> Status>,
}
