//! What can go wrong.

use std::fmt;

/// A way in which a device goes wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[repr(u8)]
pub enum FaultKind {
    /// It does not answer within the deadline.
    Silence,
    /// It gives the last value again, with a new stamp.
    Freeze,
    /// It gives NaN: in a force, in a coordinate, and in the stamp of a frame, whose pixels cannot be NaN.
    NotANumber,
    /// It gives full scale and no error. A robot has none; there this does nothing.
    Saturation,
    /// It gives a new value with the last stamp.
    StaleStamp,
    /// A value is lost on the way, and the next one comes; a command to move is lost, and nothing moves.
    Drop,
    /// The answer comes late; beyond the deadline it does not come.
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

    /// How the kind is written in reports.
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
