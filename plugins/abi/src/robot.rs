//! Function table of a robot.

use core::ffi::c_void;

use crate::device::{DeviceCalls, Stamp};
use crate::error::Error;
use crate::status::Status;

/// `taceva_pose`: pose of the tip in the frame of the sensor: position in m and a unit quaternion.
///
/// Frozen, because other structs contain a `Pose`.
///
/// ```
/// use taceva_abi::Pose;
/// let above = Pose { x: 0.0, y: 0.0, z: -0.005, qw: 1.0, qx: 0.0, qy: 0.0, qz: 0.0 }; // 5 mm above the gel, not turned
/// assert!(above.z < 0.0);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Pose {
    /// Position along x, m.
    pub x: f64,
    /// Position along y, m.
    pub y: f64,
    /// Position along z, into the gel, m.
    pub z: f64,
    /// Real part of the unit quaternion.
    pub qw: f64,
    /// Component of the quaternion about x.
    pub qx: f64,
    /// Component of the quaternion about y.
    pub qy: f64,
    /// Component of the quaternion about z.
    pub qz: f64,
}

/// `taceva_motion`: a requested motion.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
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
    /// Size of this struct, bytes.
    pub size: u32,
    /// Reserved, 0.
    pub reserved: u32,
    /// Target pose.
    pub target: Pose,
    /// Speed of the tip along its path, m/s.
    pub speed_m_per_s: f64,
}

/// `taceva_robot_calls`: functions of a robot.
///
/// New versions append fields. Each side reads at most the bytes that the other side's `size` states.
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
    /// Calls that every device has. The table begins with them.
    pub device: DeviceCalls,
    /// `[owner & open]` Reads the pose of the tip.
    pub pose: Option<
        unsafe extern "C" fn(
            *mut c_void,
            *mut Pose,
            *mut Stamp,
            timeout_ns: u64,
            *mut Error,
        ) -> Status,
    >,
    /// `[owner & open]` Starts a motion. Returns once the robot accepts the motion. The motion may continue during `wait`.
    pub move_to: Option<
        unsafe extern "C" fn(*mut c_void, *const Motion, token: *mut u64, *mut Error) -> Status,
    >,
    /// `[owner & open]` Waits until the tip rests at the target of the accepted motion.
    pub wait: Option<
        unsafe extern "C" fn(
            *mut c_void,
            token: u64,
            *mut Stamp,
            timeout_ns: u64,
            *mut Error,
        ) -> Status,
    >,
    /// `[any & open]` Stops the tip within 50 ms; idempotent. The robot stays halted until `clear_halt`.
    pub halt: Option<unsafe extern "C" fn(*mut c_void, *mut Error) -> Status>,
    /// `[owner & open]` Ends the halted state, so that the robot accepts motions again.
    pub clear_halt:
        Option<unsafe extern "C" fn(*mut c_void, timeout_ns: u64, *mut Error) -> Status>,
}
