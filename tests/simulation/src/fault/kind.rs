//! Kinds of faults.

use std::fmt;

/// Kind of fault of a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u8)]
pub enum FaultKind {
    /// The device does not answer within the deadline.
    Silence,
    /// The device returns the last value again, with a new stamp.
    Freeze,
    /// The device returns NaN: in a force, in a coordinate, or in the time stamp of a frame.
    NotANumber,
    /// The device returns full scale without an error. No effect on a robot, which has no full scale.
    Saturation,
    /// The device returns a new value with the time stamp of the last value.
    StaleStamp,
    /// A value is lost, and the caller receives the next value. A lost motion command has no effect.
    Drop,
    /// The answer is late. An answer after the deadline is lost.
    SlowLink,
}

impl FaultKind {
    /// Every kind.
    pub const ALL: [FaultKind; 7] = [
        FaultKind::Silence,
        FaultKind::Freeze,
        FaultKind::NotANumber,
        FaultKind::Saturation,
        FaultKind::StaleStamp,
        FaultKind::Drop,
        FaultKind::SlowLink,
    ];

    /// Name in reports.
    pub const fn name(self) -> &'static str {
        match self {
            FaultKind::Silence => "silence",
            FaultKind::Freeze => "freeze",
            FaultKind::NotANumber => "not-a-number",
            FaultKind::Saturation => "saturation",
            FaultKind::StaleStamp => "stale-stamp",
            FaultKind::Drop => "drop",
            FaultKind::SlowLink => "slow-link",
        }
    }
}

impl fmt::Display for FaultKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}
