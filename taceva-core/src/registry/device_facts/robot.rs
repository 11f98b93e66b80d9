//! Facts about a robot before it is opened.

use super::workspace::Workspace;
use crate::driver::Speed;
use crate::quantity::Millimetre;

/// Facts about a robot. Undeclared facts are `None`.
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
    /// Workspace of the tip: a box.
    pub workspace: Option<Workspace>,
    /// Greatest speed of the tip.
    pub speed_max: Option<Speed>,
    /// Repeatability of a pose: one standard deviation per axis.
    pub repeatability: Option<Millimetre>,
    /// Noise of a reported pose about its target: one standard deviation per axis. If `None`, the noise is the repeatability for a real robot,
    /// and 0 for a simulated robot.
    pub pose_noise: Option<Millimetre>,
    /// Deceleration after a halt, mm/s².
    pub deceleration_mm_s2: Option<f64>,
    /// Time from the receipt of a halt to rest, ms.
    pub stop_ms: Option<f64>,
    /// Delay from the measurement to the stamp of a pose, ms. A run subtracts this delay from the stamps; 0 needs no correction.
    pub latency_ms: Option<f64>,
    /// True if the robot can stop by itself at a force limit.
    pub guarded_motion: bool,
    /// True if the robot reports poses in its own base frame. The poses must be mapped to the sensor's frame before a move over a gel.
    pub base_frame: bool,
}

impl RobotFacts {
    /// The same facts with another [`workspace`](RobotFacts::workspace).
    #[must_use]
    pub fn with_workspace(mut self, workspace: impl Into<Option<Workspace>>) -> RobotFacts {
        self.workspace = workspace.into();
        self
    }

    /// The same facts with another [`speed_max`](RobotFacts::speed_max).
    #[must_use]
    pub fn with_speed_max(mut self, speed_max: impl Into<Option<Speed>>) -> RobotFacts {
        self.speed_max = speed_max.into();
        self
    }

    /// The same facts with another [`repeatability`](RobotFacts::repeatability).
    #[must_use]
    pub fn with_repeatability(
        mut self,
        repeatability: impl Into<Option<Millimetre>>,
    ) -> RobotFacts {
        self.repeatability = repeatability.into();
        self
    }

    /// The same facts with another [`pose_noise`](RobotFacts::pose_noise).
    #[must_use]
    pub fn with_pose_noise(mut self, pose_noise: impl Into<Option<Millimetre>>) -> RobotFacts {
        self.pose_noise = pose_noise.into();
        self
    }

    /// The same facts with another [`deceleration_mm_s2`](RobotFacts::deceleration_mm_s2).
    #[must_use]
    pub fn with_deceleration_mm_s2(
        mut self,
        deceleration_mm_s2: impl Into<Option<f64>>,
    ) -> RobotFacts {
        self.deceleration_mm_s2 = deceleration_mm_s2.into();
        self
    }

    /// The same facts with another [`stop_ms`](RobotFacts::stop_ms).
    #[must_use]
    pub fn with_stop_ms(mut self, stop_ms: impl Into<Option<f64>>) -> RobotFacts {
        self.stop_ms = stop_ms.into();
        self
    }

    /// The same facts with another [`latency_ms`](RobotFacts::latency_ms).
    #[must_use]
    pub fn with_latency_ms(mut self, latency_ms: impl Into<Option<f64>>) -> RobotFacts {
        self.latency_ms = latency_ms.into();
        self
    }

    /// The same facts with another [`guarded_motion`](RobotFacts::guarded_motion).
    #[must_use]
    pub fn with_guarded_motion(mut self, guarded_motion: bool) -> RobotFacts {
        self.guarded_motion = guarded_motion;
        self
    }

    /// The same facts with another [`base_frame`](RobotFacts::base_frame).
    #[must_use]
    pub fn with_base_frame(mut self, base_frame: bool) -> RobotFacts {
        self.base_frame = base_frame;
        self
    }
}
