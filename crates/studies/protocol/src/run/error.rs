//! Causes that stop a run, and the place of the tip after the stop.

use std::fmt;

use taceva_core::{DriverError, Fault, SinkError, by_count, counted};

use super::force_zero::ZeroStep;
use super::halt_reason::Trip;
use super::reference_touch::TouchFault;
use super::shear_way::ShearFault;
use crate::content_id::ContentId;
use crate::text::SceneError;

/// Error of a run that stopped early. All finished presses are safely stored, and the same call resumes the run.
#[derive(Debug)]
pub struct RunError {
    /// Unfinished press, if one had begun. It will be repeated from its start.
    pub press: Option<ContentId>,
    /// Cause of the stop.
    pub cause: StopCause,
    /// Place of the tip after the stop.
    pub left: Left,
}

/// Causes that stop a run.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StopCause {
    /// The run was cancelled.
    #[error("stopped on request")]
    Cancelled,
    /// Presses are missing because the operator skipped a step. All other presses are finished.
    #[error(
        "{} {} left because the operator skipped a step that {}: resume the same run",
        counted(*presses, "press"),
        by_count(*presses, "is", "are"),
        by_count(*presses, "it needs", "they need")
    )]
    Skipped {
        /// Number of missing presses.
        presses: usize,
    },
    /// A device failed.
    #[error("{0}")]
    Device(#[from] DriverError),
    /// The supervisor halted the robot for a reason other than a limit of the gel.
    #[error("halted: {0}")]
    Tripped(Trip),
    /// A press could not be safely stored.
    #[error("cannot record the press: {0}")]
    Log(SinkError),
    /// No valid frame of the resting tip was captured.
    #[error("{attempts} frames in a row were lost, damaged or older than the contact{}", of_last(.last))]
    Frames {
        /// Number of tries.
        attempts: u32,
        /// Last error of the sensor; `None` if the sensor returned only outdated frames.
        last: Option<String>,
    },
    /// A frame is bit-equal to the previous frame although the force changed.
    #[error(
        "frames equal earlier frames bit for bit although the force changed: the camera is frozen; restart it, check it with `taceva preview`, and continue with `--resume`"
    )]
    FrozenFrame,
    /// A motion would leave the workspace. It was not started.
    #[error(
        "a motion to {place} would leave the workspace of the plan: correct `origin_mm` and `axes` of [robot], or plan again"
    )]
    Workspace {
        /// Target of the motion, in mm.
        place: String,
    },
    /// The rig contradicts its rig file.
    #[error("{0}")]
    Rig(Box<SceneError>),
    /// The guard responds too late, so that the tip would travel too far beyond a limit.
    #[error(
        "force readings arrive up to {reaction_ms:.0} ms late on this machine, and the tip travels {overshoot_mm:.3} mm in that time: expected at most {greatest_mm:.3} mm (30 % of the allowed depth). Stop other programs, run with `chrt -f 10 taceva run …` if you do not yet, or lower `speed_mm_s` of the scene to {speed_mm_s:.2}"
    )]
    SlowGuard {
        /// Time from an exceeded limit to the halt, in ms: the 99.9th percentile over the timed readings.
        reaction_ms: f64,
        /// Travel of the tip from the exceeded limit until it is at rest, in mm.
        overshoot_mm: f64,
        /// Greatest allowed travel beyond a limit, in mm.
        greatest_mm: f64,
        /// Greatest speed in contact at which the travel would be allowed, in mm/s.
        speed_mm_s: f64,
    },
    /// In the gentle touch before the first press, force or frames did not respond as expected of a gel.
    #[error("{0}")]
    Touch(TouchFault),
    /// In a press, the shear force changed opposite to the sideways motion of the tip, unlike in the gentle touch.
    #[error("{0}")]
    Shear(ShearFault),
    /// The zero of the transducer changed too far during a press.
    #[error("{0}")]
    ZeroStep(Box<ZeroStep>),
    /// The enabling switch was not held within the time that the rig file allows.
    #[error(
        "the enabling switch was not held within {patience_s} s: hold it and continue with `--resume`; `patience_s` of [operator] sets this wait"
    )]
    Unheld {
        /// Longest time to wait, in s.
        patience_s: f64,
    },
    /// The plan needs a device, person or setting that the run lacks.
    #[error("the plan needs {0}")]
    Missing(String),
}

impl StopCause {
    /// True if force or pose was stale, no valid frame arrived, the camera was frozen, or the force zero changed. The press can then be repeated.
    pub fn is_silence(&self) -> bool {
        matches!(
            self,
            StopCause::Tripped(Trip::StaleForce { .. } | Trip::StalePose { .. })
                | StopCause::Frames { .. }
                | StopCause::FrozenFrame
                | StopCause::ZeroStep(_)
        )
    }

    /// True if force, pose or guard was too late. Emulated devices on a busy machine cause such delays.
    pub(super) fn is_late(&self) -> bool {
        matches!(
            self,
            StopCause::Tripped(Trip::StaleForce { .. } | Trip::StalePose { .. })
                | StopCause::SlowGuard { .. }
        )
    }

    /// True if the enabling switch was released. The press is repeated when the switch is held again.
    pub fn is_release(&self) -> bool {
        matches!(self, StopCause::Tripped(Trip::Released))
    }

    /// Fault for which a device stopped itself, if any. The operator must acknowledge it at the device before anything moves again.
    pub fn fault(&self) -> Option<Fault> {
        match self {
            StopCause::Device(error) => error.fault(),
            _ => None,
        }
    }
}

fn of_last(last: &Option<String>) -> String {
    last.as_ref()
        .map_or_else(String::new, |last| format!("; last error: {last}"))
}

/// Place of the tip after a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Left {
    /// Unchanged, because nothing moved.
    Untouched,
    /// Above the gel.
    Clear,
    /// Halted in place, because the force was unreliable or the robot did not execute commands.
    InPlace,
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.cause)?;
        if let Some(press) = self.press {
            write!(
                f,
                "; the unfinished press {press} is repeated when this run is resumed"
            )?;
        }
        if let Left::InPlace = self.left {
            f.write_str("; the tip stays where it is, perhaps in the gel")?;
        }
        match self.cause.fault() {
            Some(fault) => write!(
                f,
                "; inspect the rig, and acknowledge the {fault} at the device"
            ),
            None => Ok(()),
        }
    }
}

impl std::error::Error for RunError {
    fn source(&self) -> Option<&(dyn std::error::Error + 'static)> {
        Some(&self.cause)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lost_frames_are_counted_and_the_last_error_of_the_sensor_is_named() {
        let said = |last: Option<&str>| {
            let last = last.map(str::to_owned);
            StopCause::Frames { attempts: 3, last }.to_string()
        };
        let counted = "3 frames in a row were lost, damaged or older than the contact";
        assert_eq!(said(None), counted);
        let expected = format!("{counted}; last error: no light");
        assert_eq!(said(Some("no light")), expected);
    }
}
