//! Observation of a moving robot through its reports on a separate connection.

use std::sync::Arc;

use taceva_core::{Deadline, DriverError, DriverKey, Pose, RobotWatch, Stamp};

use super::Mailbox;

/// Watch that returns the pose in the next report of a robot.
#[derive(Debug)]
pub(crate) struct ReportedPose<T> {
    /// Driver of the robot, for errors.
    pub(crate) driver: DriverKey,
    pub(crate) reports: Arc<Mailbox<T>>,
    /// Function that extracts the pose of a report, or the reason why it has none.
    pub(crate) pose: fn(&T) -> Result<Pose, DriverError>,
}

/// Name of a watch in error messages.
pub(crate) const LOOK: &str = "watch the pose of the arm during a motion";

impl<T: Clone + Send> RobotWatch for ReportedPose<T> {
    fn pose(&self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let patience = deadline.remaining();
        let newest = self.reports.newest().map_or(0, |seen| seen.number);
        let seen = self.reports.next(newest, patience).map_err(|none| {
            none.while_waiting(&self.driver, LOOK, || {
                format!("no report within {patience:?}")
            })
        })?;
        Ok(((self.pose)(&seen.what)?, Stamp::at(seen.at)))
    }
}
