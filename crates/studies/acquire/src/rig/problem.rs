//! Problems that `rig check` finds, with their remedies.

use std::fmt;

use taceva_core::StampAge;

use super::listen::LISTENED;

/// Maximum time from a halt to a robot at rest, in ms. Plans have the same limit for a stated stop time.
pub(super) const HALT_MS: f64 = 50.0;

/// Problems of a rig that would reject or stop a run, with their remedies.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub enum RigProblem {
    /// A device did not open, or reading it failed.
    Failed {
        /// Name of the device: `force`, `robot`, `sensor`, `switch`, `specimen`, `unit` or `light`.
        device: &'static str,
        /// Description of the failure and its remedy.
        why: String,
    },
    /// The serial number in the certificate of a device differs from the serial number that the device reports.
    Certificate {
        /// Name of the device: `force`, `robot` or `sensor`.
        device: &'static str,
        /// Description of the contradiction and its remedy.
        why: String,
    },
    /// A device gave no readings.
    Unheard {
        /// Name of the device: `force`, `robot` or `sensor`.
        device: &'static str,
    },
    /// Force readings have gaps that would abort presses.
    Gaps {
        /// Longest gap, in ms.
        gap_ms: f64,
        /// Maximum allowed gap, in ms.
        allowed_ms: f64,
    },
    /// The measured noise is more than twice the noise that the driver states.
    Noise {
        /// Name of the device: `force` or `robot`.
        device: &'static str,
        /// Measured noise, in N or mm.
        measured: f64,
        /// Noise that the driver states, in the same unit.
        stated: f64,
    },
    /// The stamps of a device are from another clock than that of this machine.
    OtherClock {
        /// Name of the device: `force`, `robot` or `sensor`.
        device: &'static str,
        /// Greatest age of a reading on arrival, by its time stamp, in ms.
        late_ms: f64,
    },
    /// The file still has the origin and axes of a new file.
    Untaught,
    /// According to the rig file, the tip is inside the gel.
    InGel {
        /// Depth of the tip, in mm.
        depth_mm: f64,
    },
    /// The robot takes too long to stop.
    SlowHalt {
        /// Time from the halt to the end of the motion, in ms.
        ended_ms: f64,
    },
    /// The robot did not stop.
    NotHalted,
    /// The enabling switch was never reported as held, although the operator was asked to hold it.
    Unheld,
}

impl fmt::Display for RigProblem {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            RigProblem::Failed { why, .. } | RigProblem::Certificate { why, .. } => {
                f.write_str(why)
            }
            RigProblem::Unheard { device } => write!(
                f,
                "the {device} sent no valid data in {} s: check its cable, its address in the rig file, and whether another program uses it; for a plugin, `taceva plugin check` prints its errors",
                LISTENED.as_secs()
            ),
            RigProblem::Gaps { gap_ms, allowed_ms } => write!(
                f,
                "force readings arrive up to {gap_ms:.0} ms apart (limit {allowed_ms:.0} ms): stop other traffic on this network and other programs, or run with `chrt -f 10` if you do not yet"
            ),
            RigProblem::Noise {
                device,
                measured,
                stated,
            } => write!(
                f,
                "the {device} has noise of {measured:.4} {unit}, but its driver states {stated:.4} {unit}: presses may be halted without cause; check for vibration, changes of load and a mistaken unit",
                unit = if *device == "force" { "N" } else { "mm" }
            ),
            RigProblem::OtherClock { device, late_ms } => {
                write!(f, "the {device} has {}", StampAge::of(1e-3 * late_ms))
            }
            RigProblem::Untaught => f.write_str(
                "`origin_mm` and `axes` of [robot] still have the values of a new file, and the robot may move down instead of up: run `taceva rig teach`",
            ),
            RigProblem::InGel { depth_mm } => write!(
                f,
                "by `origin_mm` and `axes` of [robot] the tip is {depth_mm:.1} mm inside the gel: raise it by a centimetre, or run `taceva rig teach` if it is above the gel"
            ),
            RigProblem::SlowHalt { ended_ms } => write!(
                f,
                "the robot came to rest {ended_ms:.0} ms after a halt, expected at most {HALT_MS} ms: lower `speed_mm_s` in contact, or shorten its braking at the controller"
            ),
            RigProblem::Unheld => f.write_str(
                "the enabling switch was never read as held. Hold the switch when the check asks for it. If you held the switch, correct `byte` and `mask` of `enable`. Nothing moves without the switch",
            ),
            RigProblem::NotHalted => f.write_str(
                "the robot did not stop after a halt: do not use it; check the driver and the controller",
            ),
        }
    }
}

impl RigProblem {
    /// Device of the problem, with the names in [`RigProblem::Failed`]; `None` for a problem of the halt.
    pub fn device(&self) -> Option<&'static str> {
        match self {
            RigProblem::Failed { device, .. }
            | RigProblem::Certificate { device, .. }
            | RigProblem::Unheard { device }
            | RigProblem::Noise { device, .. }
            | RigProblem::OtherClock { device, .. } => Some(device),
            RigProblem::Gaps { .. } => Some("force"),
            RigProblem::Untaught | RigProblem::InGel { .. } => Some("robot"),
            RigProblem::Unheld => Some("switch"),
            RigProblem::SlowHalt { .. } | RigProblem::NotHalted => None,
        }
    }

    /// True if the device gave no measurement.
    pub fn is_failure(&self) -> bool {
        matches!(self, RigProblem::Failed { .. } | RigProblem::Unheard { .. })
    }
}
