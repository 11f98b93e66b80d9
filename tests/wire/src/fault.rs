//! Faults of links while the bench runs.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Device whose link can have faults.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Device {
    /// The robot: its answers and its reports.
    Robot,
    /// The force transducer.
    Force,
    /// The camera.
    Camera,
}

/// Kind of fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum FaultKind {
    /// Messages are missing, which shows as gaps if messages have numbers.
    Drop,
    /// The link stalls. Messages wait and are sent after the fault.
    Late,
    /// The link is open, but sends nothing.
    Silent,
    /// The same reading is repeated under new message numbers.
    Frozen,
    /// A reading is NaN.
    NotANumber,
    /// Messages arrive in pieces.
    Split,
    /// Several messages arrive at once.
    Merged,
    /// Bytes of another protocol precede each message.
    Foreign,
    /// Each message is preceded by the start of a message with an absurd length.
    Hostile,
    /// Message numbers are skipped, but no message is lost.
    Gap,
    /// The transducer is at the end of its range.
    Saturated,
}

/// Fault of an arm.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ArmFault {
    /// The emergency stop is pressed: the motors are off.
    EmergencyStop,
    /// The arm detects a collision.
    Collision,
}

/// An emulated arm in which tests can cause faults.
pub trait Arm: Send + Sync {
    /// Applies a fault to the arm.
    fn suffer(&self, fault: ArmFault);

    /// Selector of the driver for this arm, with its arguments.
    fn selector(&self) -> String;
}

/// A fault of a link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fault {
    /// Device of the link.
    pub device: Device,
    /// Kind of fault.
    pub kind: FaultKind,
    /// Duration of the fault.
    pub lasts: Duration,
}

impl Device {
    /// Every device.
    pub const ALL: [Device; 3] = [Device::Robot, Device::Force, Device::Camera];

    /// Name on the control port.
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

    /// Name on the control port.
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

/// Present faults.
#[derive(Debug, Default)]
pub(crate) struct Faults {
    /// End of each fault.
    on: Mutex<BTreeMap<(Device, FaultKind), Instant>>,
    /// Latency of each device's stream.
    lags: Mutex<BTreeMap<Device, Duration>>,
}

impl Faults {
    pub(crate) fn put(&self, fault: Fault) {
        let until = Instant::now() + fault.lasts;
        self.on().insert((fault.device, fault.kind), until);
    }

    /// Sets the latency of everything that `device` streams.
    pub(crate) fn set_lag(&self, device: Device, lag: Duration) {
        self.lags().insert(device, lag);
    }

    /// Latency of the stream of `device`.
    pub(crate) fn lag(&self, device: Device) -> Duration {
        self.lags().get(&device).copied().unwrap_or_default()
    }

    fn lags(&self) -> MutexGuard<'_, BTreeMap<Device, Duration>> {
        self.lags.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// True while the fault is present.
    pub(crate) fn is_on(&self, device: Device, kind: FaultKind) -> bool {
        self.left(device, kind).is_some()
    }

    /// True if a message of `device` must be dropped now.
    pub(crate) fn withholds(&self, device: Device) -> bool {
        self.is_on(device, FaultKind::Drop) || self.is_on(device, FaultKind::Silent)
    }

    /// Present delay of a message of `device`; zero without a fault.
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
