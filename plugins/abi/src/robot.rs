//! The calls of a robot.

use core::ffi::c_void;

use crate::device::{DeviceCalls, Stamp};
use crate::error::Error;
use crate::status::Status;

/// `taceva_pose`: the tip in the sensor's frame, m and a unit quaternion.
///
/// Frozen: it is part of other structs.
///
/// ```
/// use taceva_abi::Pose;
/// let above = Pose { x: 0.0, y: 0.0, z: -0.005, qw: 1.0, qx: 0.0, qy: 0.0, qz: 0.0 }; // 5 mm above the gel, not turned
/// assert!(above.z < 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Pose {
    /// Along x, in m.
    pub x: f64,
    /// Along y, in m.
    pub y: f64,
    /// Along z, into the gel, in m.
    pub z: f64,
    /// The real part of the unit quaternion.
    pub qw: f64,
    /// About x.
    pub qx: f64,
    /// About y.
    pub qy: f64,
    /// About z.
    pub qz: f64,
}

/// `taceva_motion`.
///
/// A struct with a size in front grows at its end: a side reads no further than the other's `size` says.
///
/// ```
/// use taceva_abi::{Motion, Pose};
/// let target = Pose { x: 0.0, y: 0.0, z: 0.001, qw: 1.0, qx: 0.0, qy: 0.0, qz: 0.0 };
/// let press = Motion { size: size_of::<Motion>() as u32, reserved: 0, target, speed_m_per_s: 0.002 };
/// assert_eq!(press.target.z, 0.001);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Motion {
    /// The size of this struct, in bytes.
    pub size: u32,
    /// Reserved, 0.
    pub reserved: u32,
    /// The pose to move to.
    pub target: Pose,
    /// The speed of the tip along its path, in m/s.
    pub speed_m_per_s: f64,
}

/// `taceva_robot_calls`.
///
/// A struct with a size in front grows at its end: a side reads no further than the other's `size` says.
///
/// ```
/// use taceva_abi::{DeviceCalls, RobotCalls};
/// let device = DeviceCalls { size: size_of::<RobotCalls>() as u32, reserved: 0, close: None, interrupt: None, extension: None };
/// let calls = RobotCalls { device, pose: None, move_to: None, wait: None, halt: None, clear_halt: None };
/// assert!(calls.halt.is_none(), "a host refuses a robot that cannot be halted");
/// ```
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct RobotCalls {
    /// The calls that every device has; the table begins with them.
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
    /// `[owner & open]` Waits until the tip rests at the target of the motion that `move_to` accepted.
    pub wait: Option<
        unsafe extern "C" fn(
            *mut c_void,
            token: u64,
            *mut Stamp,
            timeout_ns: u64,
            *mut Error,
        ) -> Status,
    >,
    /// `[any & open]` Stops the tip, which rests within 50 ms, and latches; idempotent.
    pub halt: Option<unsafe extern "C" fn(*mut c_void, *mut Error) -> Status>,
    /// `[owner & open]`
    pub clear_halt:
        Option<unsafe extern "C" fn(*mut c_void, timeout_ns: u64, *mut Error) -> Status>,
}
