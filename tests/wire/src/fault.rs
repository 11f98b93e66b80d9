//! Faults that are put on the links while the bench runs.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Whose link a fault is on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Device {
    /// The robot: its answers and its reports.
    Robot,
    /// The force transducer.
    Force,
    /// The camera.
    Camera,
}

/// What goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultKind {
    /// Messages are missing; their numbers, where they have any, show it.
    Drop,
    /// The link stalls: nothing is sent until the fault is over, and what was held comes late.
    Late,
    /// The link is open, and nothing comes.
    Silent,
    /// The same readings are repeated, under new numbers of the messages.
    Frozen,
    /// A reading is NaN.
    NotANumber,
    /// Messages come in pieces.
    Split,
    /// Several messages come at once.
    Merged,
    /// Bytes of another protocol stand before each message.
    Foreign,
    /// Before each message stands the beginning of one whose length is absurd.
    Hostile,
    /// Numbers of messages are left out, though no message is.
    Gap,
    /// The transducer is at the end of its range.
    Saturated,
}

/// What can happen to an arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArmFault {
    /// Somebody presses the emergency stop: the motors are off.
    EmergencyStop,
    /// It detects a collision.
    Collision,
}

/// An emulated arm, as its surroundings act on it.
pub trait Arm: Send + Sync {
    /// Does to the arm what its surroundings can.
    fn suffer(&self, fault: ArmFault);

    /// The driver that reaches it, with its arguments.
    fn selector(&self) -> String;
}

/// A fault to be put on a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fault {
    /// Whose.
    pub device: Device,
    /// Which.
    pub kind: FaultKind,
    /// How long it lasts.
    pub lasts: Duration,
}

impl Device {
    /// Every device.
    pub const ALL: [Device; 3] = [Device::Robot, Device::Force, Device::Camera];

    /// How it is written on the control port.
    pub const fn name(self) -> &'static str {
        match self {
            Device::Robot => "robot",
            Device::Force => "force",
            Device::Camera => "camera",
        }
    }
}

impl FaultKind {
    /// Every kind.
    pub const ALL: [FaultKind; 11] = [
        FaultKind::Drop,
        FaultKind::Late,
        FaultKind::Silent,
        FaultKind::Frozen,
        FaultKind::NotANumber,
        FaultKind::Split,
        FaultKind::Merged,
        FaultKind::Foreign,
        FaultKind::Hostile,
        FaultKind::Gap,
        FaultKind::Saturated,
    ];

    /// How it is written on the control port.
    pub const fn name(self) -> &'static str {
        match self {
            FaultKind::Drop => "drop",
            FaultKind::Late => "late",
            FaultKind::Silent => "silent",
            FaultKind::Frozen => "frozen",
            FaultKind::NotANumber => "nan",
            FaultKind::Split => "split",
            FaultKind::Merged => "merged",
            FaultKind::Foreign => "foreign",
            FaultKind::Hostile => "hostile",
            FaultKind::Gap => "gap",
            FaultKind::Saturated => "saturated",
        }
    }
}

impl fmt::Display for Device {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl fmt::Display for FaultKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The faults that are on now.
#[derive(Debug, Default)]
pub(crate) struct Faults {
    /// Until when.
    on: Mutex<BTreeMap<(Device, FaultKind), Instant>>,
    /// How long everything that a device streams is under way.
    lags: Mutex<BTreeMap<Device, Duration>>,
}

impl Faults {
    pub(crate) fn put(&self, fault: Fault) {
        let until = Instant::now() + fault.lasts;
        self.on().insert((fault.device, fault.kind), until);
    }

    /// Lets everything that `device` streams be under way for so long.
    pub(crate) fn set_lag(&self, device: Device, lag: Duration) {
        self.lags().insert(device, lag);
    }

    /// How long what `device` streams is under way.
    pub(crate) fn lag(&self, device: Device) -> Duration {
        self.lags().get(&device).copied().unwrap_or_default()
    }

    fn lags(&self) -> MutexGuard<'_, BTreeMap<Device, Duration>> {
        self.lags.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Whether such a fault is on.
    pub(crate) fn is_on(&self, device: Device, kind: FaultKind) -> bool {
        self.left(device, kind).is_some()
    }

    /// Whether a message of `device` is to be left out now.
    pub(crate) fn withholds(&self, device: Device) -> bool {
        self.is_on(device, FaultKind::Drop) || self.is_on(device, FaultKind::Silent)
    }

    /// How long a message of `device` has to wait now; nothing while its link is well.
    pub(crate) fn delay(&self, device: Device) -> Duration {
        self.left(device, FaultKind::Late).unwrap_or_default()
    }

    fn left(&self, device: Device, kind: FaultKind) -> Option<Duration> {
        let until = *self.on().get(&(device, kind))?;
        let left = until.saturating_duration_since(Instant::now());
        (!left.is_zero()).then_some(left)
    }

    fn on(&self) -> MutexGuard<'_, BTreeMap<(Device, FaultKind), Instant>> {
        self.on.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
