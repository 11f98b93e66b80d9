//! What the arm does now: from its reports, or asked for where it sends none.

use std::sync::Arc;
use std::time::Duration;

use taceva_core::{DriverError, ErrorKind, NotFinite, Pose, check_pose};

use super::KEY;
use super::command::Command;
use super::error::failed;
use super::exchange::{Exchange, ExchangeError};
use super::fault::XarmFault;
use super::frame::Reply;
use super::report::{ArmReport, ReportKind, State, pose_of};
use super::watch::Watch;
use crate::link::{LinkError, Mailbox, monotonic};

/// Where the arm is and what it does, at one moment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Observation {
    pub(super) state: State,
    pub(super) queued: u16,
    /// Not checked to be numbers.
    pub(super) pose: [f32; 6],
    /// On the monotonic clock.
    pub(super) at: Duration,
    /// Of the report it was read from.
    number: u64,
}

impl Observation {
    /// The pose, if it is one.
    pub(super) fn pose(&self) -> Result<Pose, NotFinite> {
        let pose = pose_of(self.pose);
        check_pose(&pose).map(|()| pose)
    }
}

/// The two ports of reports, as far as somebody listens there.
#[derive(Debug)]
pub(super) struct Observer {
    poses: Option<Watch>,
    statuses: Option<Watch>,
    /// When the controller was last asked for what it does not report.
    asked: Duration,
    /// When it was last asked for errors.
    asked_for_errors: Duration,
}

/// How often the controller is asked for what it does not report; it is not made for more.
const ASKED_EVERY: Duration = Duration::from_millis(10);
const ASKED_FOR_ERRORS_EVERY: Duration = Duration::from_millis(100);
/// How long an answer may take.
pub(super) const ANSWER: Duration = Duration::from_millis(300);
/// A pose that is older than this says nothing of where the arm is: 100 come a second.
pub(super) const STALE: Duration = Duration::from_millis(250);
/// The least time between two looks of a caller that has run out of it.
const GLANCE: Duration = Duration::from_millis(30);

impl Observer {
    /// Connects to both ports; one where nobody listens is done without.
    pub(super) fn open(
        host: &str,
        pose_port: u16,
        status_port: u16,
    ) -> Result<Observer, LinkError> {
        let open = |port, kind| match Watch::open(host, port, kind) {
            Ok(watch) => Ok(Some(watch)),
            Err(error) if error.kind() == ErrorKind::NotFound => Ok(None),
            Err(error) => Err(error),
        };
        Ok(Observer {
            poses: open(pose_port, ReportKind::Pose)?,
            statuses: open(status_port, ReportKind::Status)?,
            asked: Duration::ZERO,
            asked_for_errors: Duration::ZERO,
        })
    }

    /// Where reports of poses are left, if the arm sends any.
    pub(super) fn reports(&self) -> Option<Arc<Mailbox<ArmReport>>> {
        self.poses.as_ref().map(Watch::mailbox)
    }

    /// What the arm does now: after `last`, and not older than is of use.
    pub(super) fn observe(
        &mut self,
        exchange: &mut Exchange,
        last: Option<&Observation>,
        patience: Duration,
    ) -> Result<Observation, DriverError> {
        let Some(poses) = &self.poses else {
            return self.ask(exchange, patience);
        };
        // Who looks for the first time takes what is there, if it is fresh.
        let now = monotonic();
        let fresh = poses
            .newest()
            .filter(|seen| now.saturating_sub(seen.at) < STALE / 5);
        let after = match (last, fresh) {
            (Some(last), _) => last.number,
            (None, Some(fresh)) => fresh.number - 1,
            (None, None) => poses.newest().map_or(0, |seen| seen.number),
        };
        let seen = poses.next(after, patience).map_err(|none| {
            none.while_waiting(&KEY, "look where the arm is", || {
                format!("no report within {patience:?}")
            })
        })?;
        Ok(Observation {
            state: seen.what.state,
            queued: seen.what.queued,
            pose: seen.what.pose,
            at: seen.at,
            number: seen.number,
        })
    }

    /// What the arm does, asked for.
    fn ask(
        &mut self,
        exchange: &mut Exchange,
        patience: Duration,
    ) -> Result<Observation, DriverError> {
        let doing = "ask where the arm is";
        let refused = |error: ExchangeError| failed(error.kind(), doing, error);
        let since = monotonic().saturating_sub(self.asked);
        std::thread::sleep(ASKED_EVERY.saturating_sub(since).min(patience));
        // Whoever has no time left is answered all the same, if the controller answers at once.
        let patience = patience.clamp(GLANCE, ANSWER);
        let state = exchange
            .ask_for(Command::GetState, patience, Reply::state)
            .map_err(refused)?;
        let queued = exchange
            .ask_for(Command::GetQueued, patience, Reply::queued)
            .map_err(refused)?;
        let pose = exchange
            .ask_for(Command::GetPose, patience, Reply::pose)
            .map_err(refused)?;
        self.asked = monotonic();
        Ok(Observation {
            state: State(state),
            queued,
            pose,
            at: self.asked,
            number: 0,
        })
    }

    /// The error that the controller reports, as far as it is known without waiting; a tenth of a second old where it must be asked.
    pub(super) fn error(
        &mut self,
        exchange: &mut Exchange,
    ) -> Result<Option<XarmFault>, ExchangeError> {
        if let Some(status) = self.statuses.as_ref().and_then(Watch::newest) {
            let code = status.what.status.map_or(0, |status| status.error);
            return Ok(fault(code));
        }
        let now = monotonic();
        if now.saturating_sub(self.asked_for_errors) < ASKED_FOR_ERRORS_EVERY {
            return Ok(None);
        }
        self.asked_for_errors = now;
        error_now(exchange)
    }

    /// Whether the motors of the arm are on, where the controller reports it; the seventh joint is not there on most.
    pub(super) fn is_enabled(&self) -> Option<bool> {
        let status = self.statuses.as_ref()?.newest()?.what.status?;
        Some(status.enabled & FIRST_JOINTS == FIRST_JOINTS)
    }

    /// The mode in which the controller takes motions, where it reports it.
    pub(super) fn mode(&self) -> Option<u8> {
        let watches = [&self.poses, &self.statuses];
        let newest = watches.into_iter().flatten().find_map(Watch::newest)?;
        Some(newest.what.mode)
    }
}

/// The joints that every arm of the family has.
const FIRST_JOINTS: u8 = 0b1_1111;

/// The error that the controller has at this moment.
pub(super) fn error_now(exchange: &mut Exchange) -> Result<Option<XarmFault>, ExchangeError> {
    let [error, _] = exchange.ask_for(Command::GetError, ANSWER, Reply::codes)?;
    Ok(fault(error))
}

fn fault(code: u8) -> Option<XarmFault> {
    (code != 0).then_some(XarmFault { code })
}
