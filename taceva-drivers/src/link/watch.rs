//! Looking at a robot while it moves, by what it reports over a connection of its own.

use std::sync::Arc;

use taceva_core::{Deadline, DriverError, DriverKey, Pose, RobotWatch, Stamp};

use super::Mailbox;

/// The pose of the newest report that a robot sends by itself.
#[derive(Debug)]
pub(crate) struct ReportedPose<T> {
    /// Whose reports they are, which errors name.
    pub(crate) driver: DriverKey,
    pub(crate) reports: Arc<Mailbox<T>>,
    /// The pose that a report holds, or why it says nothing of where the tip is.
    pub(crate) pose: fn(&T) -> Result<Pose, DriverError>,
}

/// What a watch does.
pub(crate) const LOOK: &str = "look where the arm is while it moves";

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
