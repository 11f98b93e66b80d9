//! A robot that stops by itself at a force.

use core::ffi::c_void;

use crate::device::Stamp;
use crate::error::Error;
use crate::robot::{Motion, Pose};
use crate::status::Status;

/// The id of the extension.
pub const GUARDED_MOTION: &str = "taceva.robot.guarded-motion/1";

/// `taceva_guarded_stop`: how a guarded motion ended.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct GuardedStop {
    /// Of this struct.
    pub size: u32,
    /// 0: it arrived; 1: it stopped at the guard.
    pub is_guarded: u32,
    /// Where it rests.
    pub pose: Pose,
    /// Since when.
    pub stamp: Stamp,
}

/// `taceva_guarded_motion_calls`.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct GuardedMotionCalls {
    /// Of this struct.
    pub size: u32,
    /// 0.
    pub reserved: u32,
    /// `[owner & open]` Moves, and ends where the magnitude of the force reaches the guard.
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
