//! Looking at an arm while it moves, over the connection of its reports.

use std::sync::Arc;

use taceva_core::{Deadline, DriverError, ErrorKind, Pose, RobotWatch, Stamp, check_pose};

use super::error::failed;
use super::report::{Report, pose_of};
use crate::link::{Mailbox, NoNews};

const DOING: &str = "look where the arm is while it moves";

/// The pose of the newest report.
#[derive(Debug)]
pub(super) struct ReportedPose {
    pub(super) reports: Arc<Mailbox<Report>>,
}

impl RobotWatch for ReportedPose {
    fn pose(&self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let patience = deadline.remaining();
        let newest = self.reports.newest().map_or(0, |seen| seen.number);
        let seen = self.reports.next(newest, patience);
        let seen = seen.map_err(|none| match none {
            NoNews::Ended(ending) => failed(ErrorKind::Disconnected, DOING, ending.why),
            NoNews::Silent | NoNews::Interrupted => {
                let why = format!("no report within {patience:?}");
                failed(ErrorKind::Timeout, DOING, why)
            }
        })?;
        let pose = pose_of(seen.what.pose);
        check_pose(&pose).map_err(|error| failed(ErrorKind::DeviceFault, DOING, error))?;
        Ok((pose, Stamp::at(seen.at)))
    }
}
