//! Kinds of faults.

use std::fmt;

/// Kind of fault of a device.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u8)]
pub enum FaultKind {
    /// No answer within the deadline.
    Silence,
    /// The last value again, with a new stamp.
    Freeze,
    /// NaN: in a force, in a coordinate, and in the stamp of a frame, whose pixels cannot be NaN.
    NotANumber,
    /// Full scale without an error. No effect on a robot, which has no full scale.
    Saturation,
    /// A new value with the last stamp.
    StaleStamp,
    /// A value is lost, and the next one arrives. A lost motion command moves nothing.
    Drop,
    /// The answer is late. Beyond the deadline it is lost.
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
