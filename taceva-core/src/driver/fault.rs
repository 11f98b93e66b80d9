//! Faults of a robot, which a person must inspect before the robot moves again.

use crate::display::display;

/// Fault for which a device stopped by itself, as reported by the device.
///
/// After a fault, a run does not move the robot and does not clear the fault. A person acknowledges the fault at the device.
///
/// ```
/// use taceva_core::Fault;
/// assert_eq!(Fault::ALL.len(), 4);
/// assert_eq!(Fault::EmergencyStop.to_string(), "emergency stop");
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Fault {
    /// An emergency stop was pressed, or a safety guard opened.
    EmergencyStop,
    /// The robot struck something.
    Collision,
    /// The robot reached the limit of its workspace.
    Boundary,
    /// A servo, a brake or its controller failed.
    Servo,
}

impl Fault {
    /// Every fault.
    pub const ALL: [Fault; 4] = [
        Fault::EmergencyStop,
        Fault::Collision,
        Fault::Boundary,
        Fault::Servo,
    ];

    /// Name of the fault in messages, such as `emergency stop`.
    pub const fn name(self) -> &'static str {
        match self {
            Fault::EmergencyStop => "emergency stop",
            Fault::Collision => "collision",
            Fault::Boundary => "boundary",
            Fault::Servo => "servo fault",
        }
    }
}

display!(Fault, name);
