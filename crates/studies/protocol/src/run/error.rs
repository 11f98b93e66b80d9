//! Why a run stopped, and how it left the tip.

use std::fmt;

use taceva_core::{DriverError, Fault, SinkError};

use super::halt_reason::Trip;
use super::reference_touch::TouchFault;
use crate::content_id::ContentId;
use crate::text::SceneError;

/// A run that stopped before its end. Everything finished is durable, and the same call resumes it.
#[derive(Debug)]
pub struct RunError {
    /// The press that was not finished, if one had begun; it will be made again from its start.
    pub press: Option<ContentId>,
    /// Why it stopped.
    pub cause: StopCause,
    /// Where the tip was left.
    pub left: Left,
}

/// Why a run stopped.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StopCause {
    /// Somebody asked the run to stop.
    #[error("stopped on request")]
    Cancelled,
    /// Presses were left out because somebody skipped what they need; every other one is made.
    #[error(
        "{presses} presses are left, for which somebody skipped what they need: go on with the same run"
    )]
    Skipped {
        /// How many.
        presses: usize,
    },
    /// A device failed.
    #[error("{0}")]
    Device(#[from] DriverError),
    /// The supervisor halted the robot, and no limit of the gel was the reason.
    #[error("halted: {0}")]
    Tripped(Trip),
    /// What was acquired could not be made durable.
    #[error("cannot record the press: {0}")]
    Log(SinkError),
    /// No frame came that was taken after the tip rested.
    #[error("{attempts} frames in a row were lost, damaged or older than the contact{}", of_last(.last))]
    Frames {
        /// How many were tried.
        attempts: u32,
        /// What the sensor said of the last one that it could not give; `None` if it gave them all, too old.
        last: Option<String>,
    },
    /// A motion that would leave the surface or the limits; none was made.
    #[error("a motion to {place} would leave the workspace of the plan")]
    Workspace {
        /// The target, in mm.
        place: String,
    },
    /// What the rig file says does not hold on the rig.
    #[error("{0}")]
    Rig(Box<SceneError>),
    /// The machine looks on so late that a limit would be passed too far.
    #[error(
        "readings of force come up to {reaction_ms:.0} ms late on this machine, in which the tip goes on by {overshoot_mm:.3} mm: expected at most {greatest_mm:.3} mm, a part of the depth; leave the machine to the run, start it by `chrt -f 10 taceva run …`, or lower `speed_mm_s` of the scene to {speed_mm_s:.2}"
    )]
    SlowGuard {
        /// From a limit to the halt, in ms; 999 of 1,000 are sooner.
        reaction_ms: f64,
        /// How far the tip goes on until it rests, in mm.
        overshoot_mm: f64,
        /// The most that is allowed, in mm.
        greatest_mm: f64,
        /// The speed in contact at which it would be allowed, in mm/s.
        speed_mm_s: f64,
    },
    /// In the gentle touch before the first press, force or picture did not behave as those of a gel.
    #[error("{0}")]
    Touch(TouchFault),
    /// Nobody held the enabling switch for as long as the rig file waits.
    #[error(
        "nobody held the enabling switch within {patience_s} s: hold it and go on with `--resume`; `patience_s` of [operator] is how long a run waits"
    )]
    Unheld {
        /// How long, in s.
        patience_s: f64,
    },
    /// The plan needs something that the run was not given.
    #[error("the plan needs {0}")]
    Missing(String),
}

impl StopCause {
    /// Whether signals were silent: nothing is wrong but that nobody knows what is. The press is made again.
    pub fn is_silence(&self) -> bool {
        matches!(
            self,
            StopCause::Tripped(Trip::StaleForce { .. } | Trip::StalePose { .. })
                | StopCause::Frames { .. }
        )
    }

    /// Whether the enabling switch was released: the press is made again once it is held.
    pub fn is_release(&self) -> bool {
        matches!(self, StopCause::Tripped(Trip::Released))
    }

    /// The fault for which a device stopped by itself: a person acknowledges it there before anything moves again.
    pub fn fault(&self) -> Option<Fault> {
        match self {
            StopCause::Device(error) => error.fault(),
            _ => None,
        }
    }
}

fn of_last(last: &Option<String>) -> String {
    last.as_ref()
        .map_or_else(String::new, |last| format!("; the last: {last}"))
}

/// Where the tip was left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Left {
    /// Where it was found: nothing was moved.
    Untouched,
    /// Above the gel.
    Clear,
    /// Halted where it was: the force could not be trusted, or the robot did not obey, and nobody moves blind.
    InPlace,
}

impl fmt::Display for RunError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.cause)?;
        if let Some(press) = self.press {
            write!(f, "; press {press} will be made again")?;
        }
        if let Left::InPlace = self.left {
            f.write_str("; the tip was left where it stood, perhaps in the gel")?;
        }
        match self.cause.fault() {
            Some(fault) => write!(f, "; look, and acknowledge the {fault} at the device"),
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
        let expected = format!("{counted}; the last: no light");
        assert_eq!(said(Some("no light")), expected);
    }
}
