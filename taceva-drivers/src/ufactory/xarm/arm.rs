//! Robot implementation for an xArm.

use std::collections::BTreeMap;
use std::sync::Arc;

use taceva_core::{
    Deadline, DriverError, ErrorKind, ExpiringMotion, Halt, Pose, Robot, RobotWatch, Speed, Stamp,
    check_pose,
};

use super::KEY;
use super::command::{Command, Mode, TargetState};
use super::error::{failed, unanswered};
use super::exchange::Exchange;
use super::firmware::Firmware;
use super::identity::settings;
use super::limits::ArmLimits;
use super::observe::{ANSWER, Observer, error_now, state_now};
use super::options::XarmOptions;
use super::report::{ArmReport, pose_of};
use super::stop::{Keeper, Place, Stop};
use crate::link::monotonic;
use crate::link::watch::{LOOK, ReportedPose};

/// A connected arm.
#[derive(Debug)]
pub(super) struct Arm {
    /// Monitor of the stop connection. The first field is dropped before the connections that the monitor uses.
    keeper: Keeper,
    pub(super) exchange: Exchange,
    pub(super) observer: Observer,
    pub(super) options: XarmOptions,
    is_emulated: bool,
    /// Answer of the controller to the version query.
    version: String,
    /// Speed and acceleration limits of the controller; `None` if unknown.
    limits: Option<ArmLimits>,
}

/// Prefix of the serial number of an emulated arm (`taceva-wire`).
const EMULATED: &str = "TACEVA-SIM";

/// Version assumed until the controller answers the version query. The encoding of this query is the same in all versions.
const UNKNOWN: Firmware = Firmware::new(0, 0, 0);

impl Arm {
    /// Connects to an arm without moving it or changing its state.
    pub(super) fn open(options: XarmOptions) -> Result<Arm, DriverError> {
        let doing = "connect to the arm";
        let XarmOptions { host, port, .. } = &options;
        let mut exchange = Exchange::open(host, *port, UNKNOWN).map_err(unanswered(doing))?;
        let version = exchange
            .ask(Command::GetVersion, ANSWER)
            .map_err(unanswered(doing))?;
        let version = version.text();
        let firmware =
            Firmware::parse(&version).map_err(|error| failed(ErrorKind::Protocol, doing, error))?;
        exchange.set_firmware(firmware);
        let mut line = Exchange::open(host, *port, firmware).map_err(unanswered(doing))?;
        line.ask(Command::GetState, ANSWER)
            .map_err(unanswered(doing))?;
        let place = Place {
            host: host.clone(),
            port: *port,
            firmware,
        };
        let keeper = Keeper::start(line, exchange.writer(), place)
            .map_err(|error| failed(ErrorKind::Internal, doing, error))?;
        let observer = Observer::open(host, options.pose_port, options.status_port)
            .map_err(|error| failed(error.kind(), doing, error))?;
        let limits = ArmLimits::ask(host, options.rich_port);
        if let Some(limits) = &limits {
            limits
                .admit_acceleration(options.acceleration_mm_s2)
                .map_err(|why| failed(ErrorKind::InvalidArgument, doing, why))?;
        }
        Ok(Arm {
            keeper,
            exchange,
            observer,
            options,
            is_emulated: version.contains(EMULATED),
            version,
            limits,
        })
    }

    pub(super) fn stopping(&self) -> &Stop {
        self.keeper.stop()
    }

    /// Makes the controller ready after a stop by this driver. Fails if the controller reports an error.
    pub(super) fn stand_by(&mut self, doing: &'static str) -> Result<(), DriverError> {
        if let Some(fault) = error_now(&mut self.exchange).map_err(unanswered(doing))? {
            return Err(fault.met(doing));
        }
        self.stopping()
            .is_obeyed(ANSWER)
            .map_err(unanswered(doing))?;
        self.take(Mode::Position, doing)
    }

    /// Checks that `target` is in the workspace, and that `speed` is within the limits of the options and of the controller.
    pub(super) fn admit(&self, target: &Pose, speed: Speed) -> Result<(), DriverError> {
        let doing = "move the arm";
        check_pose(target).map_err(|error| failed(ErrorKind::InvalidArgument, doing, error))?;
        if let Some(workspace) = self.options.workspace
            && !workspace.contains(&target.position)
        {
            let why = format!("{} is outside the workspace {workspace}", target.position);
            return Err(failed(ErrorKind::OutOfRange, doing, why));
        }
        let most = self.options.speed_max;
        if speed > most {
            let why = format!("a speed of {speed}, expected at most {most}");
            return Err(failed(ErrorKind::OutOfRange, doing, why));
        }
        let admitted = self.limits.map_or(Ok(()), |limits| limits.admit(speed));
        admitted.map_err(|why| failed(ErrorKind::OutOfRange, doing, why))
    }

    /// Sets the motion mode and makes the controller ready, which stops any motion.
    pub(super) fn take(&mut self, mode: Mode, doing: &'static str) -> Result<(), DriverError> {
        let ready = [
            Command::SetMode(mode),
            Command::SetState(TargetState::Ready),
        ];
        for command in ready {
            self.exchange
                .ask(command, ANSWER)
                .map_err(unanswered(doing))?;
        }
        let state = state_now(&mut self.exchange, ANSWER).map_err(unanswered(doing))?;
        if state.0 > LAST_GOOD_STATE {
            let why = format!(
                "the controller does not become ready; it is still in state {}",
                state.0
            );
            return Err(failed(ErrorKind::DeviceFault, doing, why));
        }
        self.see_ready(mode)
    }

    /// Waits up to 0.3 s for a report that shows the ready state and `mode`. Older reports may still show an earlier stop.
    fn see_ready(&mut self, mode: Mode) -> Result<(), DriverError> {
        let until = monotonic() + ANSWER;
        let mut last = self.observer.observe(&mut self.exchange, None, ANSWER)?;
        let is_other = |arm: &Arm| arm.observer.mode().is_some_and(|seen| seen != mode as u8);
        while (!last.state.is_ready() || is_other(self)) && monotonic() < until {
            last = self
                .observer
                .observe(&mut self.exchange, Some(&last), ANSWER)?;
        }
        Ok(())
    }
}

/// Converts the pose of a report. Fails if a number is not finite.
fn reported_pose(report: &ArmReport) -> Result<Pose, DriverError> {
    let pose = pose_of(report.pose);
    check_pose(&pose).map_err(|error| failed(ErrorKind::DeviceFault, LOOK, error))?;
    Ok(pose)
}

/// Highest state number of an arm that is not stopped. States 0 to 3 are ready, moving and paused.
const LAST_GOOD_STATE: u8 = 3;

impl Robot for Arm {
    fn is_emulated(&self) -> bool {
        self.is_emulated
    }

    fn settings(&self) -> BTreeMap<String, String> {
        settings(&self.version)
    }

    fn warnings(&self) -> Vec<String> {
        let port = self.options.rich_port;
        let unheld = self.limits.is_none().then(|| {
            format!(
                "the controller sends no complete report on port {port}, so its speed limits are unknown, and it replaces a speed beyond them without an error: open this port between this machine and the controller, or state `rich_port`"
            )
        });
        unheld.into_iter().collect()
    }

    fn pose(&mut self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let seen = self
            .observer
            .observe(&mut self.exchange, None, deadline.remaining())?;
        let pose = seen
            .pose()
            .map_err(|error| failed(ErrorKind::DeviceFault, "read the pose of the arm", error))?;
        Ok((pose, Stamp::at(seen.at)))
    }

    fn move_to(
        &mut self,
        target: Pose,
        speed: Speed,
        deadline: Deadline,
    ) -> Result<Stamp, DriverError> {
        self.admit(&target, speed)?;
        self.go(target, speed, deadline)
    }

    fn halt_handle(&self) -> Arc<dyn Halt> {
        Arc::clone(self.keeper.stop()) as Arc<dyn Halt>
    }

    fn watch_handle(&self) -> Option<Arc<dyn RobotWatch>> {
        let reports = self.observer.reports()?;
        Some(Arc::new(ReportedPose {
            driver: KEY,
            reports,
            pose: reported_pose,
        }))
    }

    fn expiring_motion(&mut self) -> Option<&mut dyn ExpiringMotion> {
        match self.exchange.firmware().takes_expiring_velocities() {
            true => Some(self),
            false => None,
        }
    }

    fn clear_halt(&mut self, _: Deadline) -> Result<(), DriverError> {
        // Release first, so that a concurrent halt is kept.
        self.stopping().release();
        self.stand_by("end the halt")
    }
}
