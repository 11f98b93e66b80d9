//! Current state of the arm, from reports, or from queries if the arm sends no reports.

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

/// Pose, state and number of queued motions of the arm at one moment.
#[derive(Clone, Copy, Debug)]
pub(super) struct Observation {
    pub(super) state: State,
    pub(super) queued: u16,
    /// Pose of the tip: x, y, z in mm; roll, pitch, yaw in rad; may contain NaN.
    pub(super) pose: [f32; 6],
    /// Time of the observation on the monotonic clock.
    pub(super) at: Duration,
    /// Number of the report in its mailbox; 0 for a queried state.
    number: u64,
}

impl Observation {
    /// Pose of the tip. Fails if a number is not finite.
    pub(super) fn pose(&self) -> Result<Pose, NotFinite> {
        let pose = pose_of(self.pose);
        check_pose(&pose).map(|()| pose)
    }
}

/// Observes the arm by the report ports that accept connections, or by queries.
#[derive(Debug)]
pub(super) struct Observer {
    poses: Option<Watch>,
    statuses: Option<Watch>,
    /// Time of the last query of the state, on the monotonic clock.
    asked: Duration,
    /// Time of the last query of errors, on the monotonic clock.
    asked_for_errors: Duration,
}

/// Minimum interval of state queries. The controller supports no higher rate.
const ASKED_EVERY: Duration = Duration::from_millis(10);
const ASKED_FOR_ERRORS_EVERY: Duration = Duration::from_millis(100);
/// Timeout for the answer to a query.
pub(super) const ANSWER: Duration = Duration::from_millis(300);
/// Timeout for the next pose report of a moving arm, which sends 100 per second.
pub(super) const STALE: Duration = Duration::from_millis(250);
/// Minimum timeout of a query, for callers past their deadline.
const GLANCE: Duration = Duration::from_millis(30);

impl Observer {
    /// Connects to both report ports. Ignores a port that refuses the connection.
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

    /// Mailbox of pose reports; `None` if the arm sends none.
    pub(super) fn reports(&self) -> Option<Arc<Mailbox<ArmReport>>> {
        self.poses.as_ref().map(Watch::mailbox)
    }

    /// Waits up to `patience` for a state of the arm that is newer than `last`. Without `last`, accepts a report at most a fifth of [`STALE`] old.
    pub(super) fn observe(
        &mut self,
        exchange: &mut Exchange,
        last: Option<&Observation>,
        patience: Duration,
    ) -> Result<Observation, DriverError> {
        let Some(poses) = &self.poses else {
            return self.ask(exchange, patience);
        };
        // The first observation uses an existing report if it is fresh.
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
            none.while_waiting(&KEY, "read the pose of the arm", || {
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

    /// Queries the state, the number of queued motions and the pose, at most every 10 ms.
    fn ask(
        &mut self,
        exchange: &mut Exchange,
        patience: Duration,
    ) -> Result<Observation, DriverError> {
        let doing = "query the pose of the arm";
        let refused = |error: ExchangeError| failed(error.kind(), doing, error);
        let since = monotonic().saturating_sub(self.asked);
        std::thread::sleep(ASKED_EVERY.saturating_sub(since).min(patience));
        // A caller past its deadline still gets an immediate answer.
        let patience = patience.clamp(GLANCE, ANSWER);
        let state = state_now(exchange, patience).map_err(refused)?;
        let queued = exchange
            .ask_for(Command::GetQueued, patience, Reply::queued)
            .map_err(refused)?;
        let pose = exchange
            .ask_for(Command::GetPose, patience, Reply::pose)
            .map_err(refused)?;
        self.asked = monotonic();
        Ok(Observation {
            state,
            queued,
            pose,
            at: self.asked,
            number: 0,
        })
    }

    /// Error of the controller, from its reports. Without reports, queries the error at most every 100 ms and returns `None` in between.
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

    /// True if the motors of the first five joints are on; `None` without reports. Other joints are ignored, because some arms lack them.
    pub(super) fn is_enabled(&self) -> Option<bool> {
        let status = self.statuses.as_ref()?.newest()?.what.status?;
        Some(status.enabled & FIRST_JOINTS == FIRST_JOINTS)
    }

    /// Motion mode in the newest report; `None` without reports.
    pub(super) fn mode(&self) -> Option<u8> {
        let watches = [&self.poses, &self.statuses];
        let newest = watches.into_iter().flatten().find_map(Watch::newest)?;
        Some(newest.what.mode)
    }
}

/// Bit mask of the five joints that every xArm has.
const FIRST_JOINTS: u8 = 0b1_1111;

/// Queries the current state of the controller. Reports may arrive late and show a stop that has ended.
pub(super) fn state_now(
    exchange: &mut Exchange,
    patience: Duration,
) -> Result<State, ExchangeError> {
    let state = exchange.ask_for(Command::GetState, patience, Reply::state)?;
    Ok(State(state))
}

/// Queries the current error of the controller.
pub(super) fn error_now(exchange: &mut Exchange) -> Result<Option<XarmFault>, ExchangeError> {
    let [error, _] = exchange.ask_for(Command::GetError, ANSWER, Reply::codes)?;
    Ok(fault(error))
}

fn fault(code: u8) -> Option<XarmFault> {
    (code != 0).then_some(XarmFault { code })
}
