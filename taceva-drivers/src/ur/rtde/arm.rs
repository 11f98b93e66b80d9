//! Robot implementation for an arm of Universal Robots.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use taceva_core::{
    Deadline, DriverError, ErrorKind, ExpiringMotion, Halt, Pose, Robot, RobotWatch, Speed, Stamp,
    check_pose,
};

use super::KEY;
use super::message::ArmState;
use super::rotation::pose_of;
use super::safety::ArmFault;
use super::script::{ScriptLine, numbered_stop, stop};
use super::states::States;
use crate::link::watch::{LOOK, ReportedPose};
use crate::link::{LinkError, Seen, monotonic};

/// Address and limits of an arm.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct UrOptions {
    pub(super) host: String,
    pub(super) port: u16,
    pub(super) script_port: u16,
    pub(super) rate_hz: f64,
    pub(super) speed_max: Speed,
    pub(super) acceleration_mm_s2: f64,
    pub(super) deceleration_mm_s2: f64,
}

/// A connected arm.
#[derive(Debug)]
pub(super) struct Arm {
    pub(super) options: UrOptions,
    pub(super) states: States,
    pub(super) motions: ScriptLine,
    pub(super) stop: Arc<Stop>,
}

/// Halt of the arm from any thread: a latch in the driver, and a separate connection.
#[derive(Debug)]
pub(super) struct Stop {
    is_halted: AtomicBool,
    /// True after the robot is dropped. A halt then does nothing.
    is_gone: AtomicBool,
    line: ScriptLine,
    deceleration_m_s2: f64,
    sent: Mutex<Sent>,
}

/// Last stop that was sent.
#[derive(Debug)]
struct Sent {
    /// Sequence number of the stop. The controller reports this number once it begins the stop.
    number: i32,
    /// Time at which the stop was sent, on the monotonic clock; `None` before the first stop.
    at: Option<Duration>,
}

impl Sent {
    /// Value before the first stop. The first number depends on the time, because the controller may still report the number of an earlier
    /// connection.
    fn none() -> Sent {
        let number = monotonic().as_millis() & 0x3fff_ffff;
        Sent {
            number: i32::try_from(number).unwrap_or_default(),
            at: None,
        }
    }
}

/// Time after which a stop that the controller has not reported counts as lost.
const LOST_AFTER: Duration = Duration::from_secs(2);

impl Stop {
    pub(super) fn is_halted(&self) -> bool {
        self.is_halted.load(Ordering::Acquire)
    }

    pub(super) fn is_alive(&self) -> bool {
        self.line.is_alive()
    }

    /// Stop program for the connection for motions, where it arrives after every earlier program.
    pub(super) fn program(&self) -> String {
        stop(self.deceleration_m_s2)
    }

    /// Sends a stop with a new number, which the controller will report.
    pub(super) fn send(&self) -> Result<(), LinkError> {
        let mut sent = self.sent();
        sent.number = sent.number.wrapping_add(1);
        sent.at = Some(monotonic());
        let program = numbered_stop(sent.number, self.deceleration_m_s2);
        self.line.send(&program)
    }

    /// True if no stop is pending: the last stop has the number that the controller reports as `number`, or it counts as lost. A pending
    /// stop could end a later motion.
    pub(super) fn is_obeyed(&self, number: i32) -> bool {
        let sent = self.sent();
        sent.number == number
            || sent
                .at
                .is_none_or(|at| monotonic().saturating_sub(at) > LOST_AFTER)
    }

    fn sent(&self) -> MutexGuard<'_, Sent> {
        self.sent.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Halt for Stop {
    fn halt(&self) -> Result<(), DriverError> {
        self.is_halted.store(true, Ordering::Release);
        if self.is_gone.load(Ordering::Acquire) {
            return Ok(());
        }
        let sent = self.send();
        sent.map_err(|error| failed(ErrorKind::Disconnected, "stop the arm", error))
    }
}

/// Creates an error of this driver that occurred while `doing`, with the reason `why`.
pub(super) fn failed(
    kind: ErrorKind,
    doing: &'static str,
    why: impl Into<Box<dyn std::error::Error + Send + Sync>>,
) -> DriverError {
    DriverError::new(kind, &KEY, doing).because(why)
}

/// Longest wait for the state that the warnings need.
const FIRST: Duration = Duration::from_secs(2);
/// Maximum age of a state that counts as current.
const FRESH: Duration = Duration::from_millis(50);
pub(super) const M_A_MM: f64 = 1e-3;

impl Arm {
    /// Connects to an arm without moving it or changing its state.
    pub(super) fn open(options: UrOptions) -> Result<Arm, DriverError> {
        let doing = "connect to the arm";
        let UrOptions {
            host, script_port, ..
        } = &options;
        let states = States::open(host, options.port, options.rate_hz)
            .map_err(|error| failed(error.kind(), doing, error))?;
        let line = || {
            ScriptLine::open(host, *script_port).map_err(|error| failed(error.kind(), doing, error))
        };
        let (motions, stopping) = (line()?, line()?);
        Ok(Arm {
            states,
            motions,
            stop: Arc::new(Stop {
                is_halted: AtomicBool::new(false),
                is_gone: AtomicBool::new(false),
                line: stopping,
                deceleration_m_s2: options.deceleration_mm_s2 * M_A_MM,
                sent: Mutex::new(Sent::none()),
            }),
            options,
        })
    }

    /// Checks that `target` is finite and that `speed` is within the limit of the options.
    pub(super) fn admit(&self, target: &Pose, speed: Speed) -> Result<(), DriverError> {
        let doing = "move the arm";
        check_pose(target).map_err(|error| failed(ErrorKind::InvalidArgument, doing, error))?;
        let most = self.options.speed_max;
        if speed > most {
            let why = format!("a speed of {speed}, expected at most {most}");
            return Err(failed(ErrorKind::OutOfRange, doing, why));
        }
        Ok(())
    }

    /// Waits for a state with a number above `after`. Without `after`, also accepts the newest state if it is at most [`FRESH`] old.
    pub(super) fn look(
        &self,
        after: Option<u64>,
        patience: Duration,
    ) -> Result<Seen<ArmState>, DriverError> {
        let doing = "read the pose of the arm";
        let mailbox = self.states.mailbox();
        let after = after.unwrap_or_else(|| {
            let newest = mailbox.newest();
            let now = monotonic();
            newest.map_or(0, |seen| match now.saturating_sub(seen.at) < FRESH {
                true => seen.number - 1,
                false => seen.number,
            })
        });
        mailbox.next(after, patience).map_err(|none| {
            none.while_waiting(&KEY, doing, || format!("no state within {patience:?}"))
        })
    }
}

/// Pose of a state. Fails if a number is not finite.
pub(super) fn numbered_pose(state: &ArmState, doing: &'static str) -> Result<Pose, DriverError> {
    pose_of(state.pose).ok_or_else(|| {
        let why = format!("a pose of {:?}, expected finite numbers", state.pose);
        failed(ErrorKind::DeviceFault, doing, why)
    })
}

/// Pose of a state. Fails after a safety stop or a fault of the arm, or if a number is not finite.
fn watched_pose(state: &ArmState) -> Result<Pose, DriverError> {
    match ArmFault::of(state).filter(|fault| fault.kind().is_some()) {
        Some(fault) => Err(fault.met(LOOK)),
        None => numbered_pose(state, LOOK),
    }
}

impl Robot for Arm {
    fn pose(&mut self, deadline: Deadline) -> Result<(Pose, Stamp), DriverError> {
        let seen = self.look(None, deadline.remaining())?;
        let pose = numbered_pose(&seen.what, "read the pose of the arm")?;
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
        Arc::clone(&self.stop) as Arc<dyn Halt>
    }

    fn watch_handle(&self) -> Option<Arc<dyn RobotWatch>> {
        Some(Arc::new(ReportedPose {
            driver: KEY,
            reports: Arc::clone(self.states.mailbox()),
            pose: watched_pose,
        }))
    }

    fn settings(&self) -> BTreeMap<String, String> {
        let version = Some(self.states.version()).filter(|version| !version.is_empty());
        let named = version.map(|version| ("firmware".to_owned(), version.to_owned()));
        named.into_iter().collect()
    }

    fn warnings(&self) -> Vec<String> {
        // No setting: a person may move the slider between the sessions of a recording.
        let percent = self
            .look(None, FIRST)
            .map(|seen| (100.0 * seen.what.slider).round());
        let reduced = percent.ok().filter(|percent| *percent < 100.0);
        let warned = reduced.map(|percent| {
            format!(
                "the speed slider is at {percent} %, so the arm moves slower than commanded: set it to 100 % on the pendant"
            )
        });
        warned.into_iter().collect()
    }

    fn expiring_motion(&mut self) -> Option<&mut dyn ExpiringMotion> {
        Some(self)
    }

    fn clear_halt(&mut self, deadline: Deadline) -> Result<(), DriverError> {
        // Release first, so that a concurrent halt is kept.
        self.stop.is_halted.store(false, Ordering::Release);
        let seen = self.look(None, deadline.remaining())?;
        match ArmFault::of(&seen.what) {
            None => Ok(()),
            Some(fault) => Err(fault.met("end the halt")),
        }
    }
}

impl Drop for Arm {
    fn drop(&mut self) {
        self.stop.is_gone.store(true, Ordering::Release);
    }
}
