//! Facts about a robot before it is opened.

use super::workspace::Workspace;
use crate::driver::Speed;
use crate::quantity::Millimetre;

/// Facts that a driver declares about a robot. An undeclared fact is `None`, or `false` for a `bool`.
///
/// ```
/// use taceva_core::{RobotFacts, Speed};
/// let facts = RobotFacts::default().with_speed_max(Speed::try_new(100.0)?);
/// assert_eq!((facts.workspace, facts.guarded_motion), (None, false));
/// # Ok::<(), taceva_core::SpeedError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct RobotFacts {
    /// Box of the allowed positions of the tip.
    pub workspace: Option<Workspace>,
    /// Greatest speed of the tip.
    pub speed_max: Option<Speed>,
    /// Repeatability of the tip's position: one standard deviation along each axis.
    pub repeatability: Option<Millimetre>,
    /// Noise of the reported position about the target position: one standard deviation along each axis. `None` means the repeatability for a real
    /// robot, and 0 for a simulated robot.
    pub pose_noise: Option<Millimetre>,
    /// Deceleration after a halt, mm/s².
    pub deceleration_mm_s2: Option<f64>,
    /// Time from the receipt of a halt command to standstill, ms.
    pub stop_ms: Option<f64>,
    /// Delay from the measurement of a pose to its time stamp, ms. A run subtracts this delay from the stamps.
    pub latency_ms: Option<f64>,
    /// True if the robot can stop by itself at a force limit.
    pub guarded_motion: bool,
    /// True if the robot reports poses in its own base frame. The poses must be mapped to the sensor's frame before a move over a gel.
    pub base_frame: bool,
}

impl RobotFacts {
    /// The same facts with the given [`workspace`](RobotFacts::workspace).
    #[must_use]
    pub fn with_workspace(mut self, workspace: impl Into<Option<Workspace>>) -> RobotFacts {
        self.workspace = workspace.into();
        self
    }

    /// The same facts with the given [`speed_max`](RobotFacts::speed_max).
    #[must_use]
    pub fn with_speed_max(mut self, speed_max: impl Into<Option<Speed>>) -> RobotFacts {
        self.speed_max = speed_max.into();
        self
    }

    /// The same facts with the given [`repeatability`](RobotFacts::repeatability).
    #[must_use]
    pub fn with_repeatability(
        mut self,
        repeatability: impl Into<Option<Millimetre>>,
    ) -> RobotFacts {
        self.repeatability = repeatability.into();
        self
    }

    /// The same facts with the given [`pose_noise`](RobotFacts::pose_noise).
    #[must_use]
    pub fn with_pose_noise(mut self, pose_noise: impl Into<Option<Millimetre>>) -> RobotFacts {
        self.pose_noise = pose_noise.into();
        self
    }

    /// The same facts with the given [`deceleration_mm_s2`](RobotFacts::deceleration_mm_s2).
    #[must_use]
    pub fn with_deceleration_mm_s2(
        mut self,
        deceleration_mm_s2: impl Into<Option<f64>>,
    ) -> RobotFacts {
        self.deceleration_mm_s2 = deceleration_mm_s2.into();
        self
    }

    /// The same facts with the given [`stop_ms`](RobotFacts::stop_ms).
    #[must_use]
    pub fn with_stop_ms(mut self, stop_ms: impl Into<Option<f64>>) -> RobotFacts {
        self.stop_ms = stop_ms.into();
        self
    }

    /// The same facts with the given [`latency_ms`](RobotFacts::latency_ms).
    #[must_use]
    pub fn with_latency_ms(mut self, latency_ms: impl Into<Option<f64>>) -> RobotFacts {
        self.latency_ms = latency_ms.into();
        self
    }

    /// The same facts with the given [`guarded_motion`](RobotFacts::guarded_motion).
    #[must_use]
    pub fn with_guarded_motion(mut self, guarded_motion: bool) -> RobotFacts {
        self.guarded_motion = guarded_motion;
        self
    }

    /// The same facts with the given [`base_frame`](RobotFacts::base_frame).
    #[must_use]
    pub fn with_base_frame(mut self, base_frame: bool) -> RobotFacts {
        self.base_frame = base_frame;
        self
    }
}
