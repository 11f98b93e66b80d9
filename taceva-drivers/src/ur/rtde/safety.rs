//! Safety states that prevent motion of an arm.

use std::fmt;

use taceva_core::{DriverError, ErrorKind, Fault};

use super::arm::failed;

use super::message::ArmState;

/// Reason why an arm does not move.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum ArmFault {
    EmergencyStop,
    /// Protective stop: a collision, or a violated limit of the safety configuration.
    ProtectiveStop,
    /// Safeguard stop: a person is in the protected area.
    SafeguardStop,
    Violation,
    Fault,
    /// Robot mode is not running: the arm is off, or its brakes are closed.
    NotRunning {
        mode: i32,
    },
}

/// Bit of the safety status for a protective stop. The next constants are the other bits.
const PROTECTIVE_STOPPED: u32 = 1 << 2;
const SAFEGUARD_STOPPED: u32 = 1 << 4;
const SYSTEM_EMERGENCY_STOPPED: u32 = 1 << 5;
const ROBOT_EMERGENCY_STOPPED: u32 = 1 << 6;
const EMERGENCY_STOPPED: u32 = 1 << 7;
const VIOLATION: u32 = 1 << 8;
const FAULT: u32 = 1 << 9;
/// Robot mode of an arm with power on and open brakes.
const RUNNING: i32 = 7;

impl ArmFault {
    /// Kind of fault for a safety stop or a fault; `None` for [`ArmFault::NotRunning`].
    pub(super) fn kind(self) -> Option<Fault> {
        match self {
            ArmFault::EmergencyStop => Some(Fault::EmergencyStop),
            ArmFault::ProtectiveStop => Some(Fault::Collision),
            ArmFault::SafeguardStop | ArmFault::Violation => Some(Fault::Boundary),
            ArmFault::Fault => Some(Fault::Servo),
            ArmFault::NotRunning { .. } => None,
        }
    }

    /// Converts the fault into an error that occurred while `doing`.
    pub(super) fn met(self, doing: &'static str) -> DriverError {
        let error = failed(ErrorKind::DeviceFault, doing, self);
        match self.kind() {
            Some(kind) => error.with_fault(kind),
            None => error,
        }
    }

    /// Most serious fault in `state`; `None` if the arm may move.
    pub(super) fn of(state: &ArmState) -> Option<ArmFault> {
        let any = |bits: u32| state.safety & bits != 0;
        if any(EMERGENCY_STOPPED | ROBOT_EMERGENCY_STOPPED | SYSTEM_EMERGENCY_STOPPED) {
            Some(ArmFault::EmergencyStop)
        } else if any(FAULT) {
            Some(ArmFault::Fault)
        } else if any(VIOLATION) {
            Some(ArmFault::Violation)
        } else if any(PROTECTIVE_STOPPED) {
            Some(ArmFault::ProtectiveStop)
        } else if any(SAFEGUARD_STOPPED) {
            Some(ArmFault::SafeguardStop)
        } else if state.robot_mode != RUNNING {
            let mode = state.robot_mode;
            Some(ArmFault::NotRunning { mode })
        } else {
            None
        }
    }
}

impl fmt::Display for ArmFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            ArmFault::EmergencyStop => f.write_str("the emergency stop was pressed"),
            ArmFault::ProtectiveStop => {
                f.write_str("a protective stop: a collision was detected, or a limit was exceeded")
            }
            ArmFault::SafeguardStop => f.write_str(
                "a safeguard stop: the safeguard input is open; clear the area, check its door or light curtain, then reset the safeguard",
            ),
            ArmFault::Violation => f.write_str("a safety limit was violated"),
            ArmFault::Fault => f.write_str("its safety system reports a fault"),
            ArmFault::NotRunning { mode } => {
                write!(f, "it is in mode {mode}, expected 7: power on, brakes open")
            }
        }?;
        f.write_str("; inspect the arm, then clear the stop by hand at the teach pendant")
    }
}

impl std::error::Error for ArmFault {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gravest_reason_is_named() {
        let fault = |safety, robot_mode| {
            ArmFault::of(&ArmState {
                pose: [0.0; 6],
                robot_mode,
                safety,
                runtime: 1,
                slider: 1.0,
                stop: 0,
            })
        };
        assert_eq!(fault(1, 7), None);
        assert_eq!(fault(1, 5), Some(ArmFault::NotRunning { mode: 5 }));
        assert_eq!(fault(0b100, 7), Some(ArmFault::ProtectiveStop));
        assert_eq!(fault(0b1_0000, 7), Some(ArmFault::SafeguardStop));
        assert_eq!(fault(0b1100_0100, 3), Some(ArmFault::EmergencyStop));
    }
}
